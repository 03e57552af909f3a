// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_tridiagonal_h
#define voussoir_tridiagonal_h

#include <vector>

namespace Voussoir
{
  /** The symmetric matrix that Lanczos' method makes of a large one. Its largest eigenvalue comes near that
   * of the large one from below. */
  struct Tridiagonal
  {
    std::vector<double> diagonal, beside; ///< beside: at least as many as diagonal, less one

    /** Of at least one row. */
    double largest_eigenvalue() const;

    /** Returns the residual that an @p eigenvalue of this matrix has in the large one: the large matrix has
     * an eigenvalue within that distance. Needs as many values in #beside as in #diagonal. */
    double residual(double eigenvalue) const;
  };
} // namespace Voussoir

#endif
