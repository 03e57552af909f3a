// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_tridiagonal_h
#define voussoir_tridiagonal_h

#include <vector>

namespace Voussoir
{
  /** Symmetric tridiagonal matrix of the Lanczos method for a large symmetric matrix. Its largest eigenvalue
   * approaches that of the large matrix from below. */
  struct Tridiagonal
  {
    std::vector<double> diagonal, off_diagonal; ///< off_diagonal: at least n - 1 values

    /** Returns the largest eigenvalue. The matrix must have at least one row. */
    double largest_eigenvalue() const;

    /** Returns the residual of an @p eigenvalue of this matrix in the large one. The large matrix has an
     * eigenvalue within that distance. Requires as many values in #off_diagonal as in #diagonal. */
    double residual(double eigenvalue) const;
  };
} // namespace Voussoir

#endif
