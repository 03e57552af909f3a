// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_single_stiffness_h
#define voussoir_single_stiffness_h

#include <voussoir/solid/structure.h>

namespace Voussoir
{
  /** Stiffness matrix of a structure in single precision, for products in double precision. It has half of the memory
   * traffic, and its own symmetric values, so that a time integration that uses it alone keeps its energy. */
  class SingleStiffness
  {
  public:
    explicit SingleStiffness(const Structure &structure);

    /** Sets y = y_rest + K (u - u_rest), three values per node [N]. The result does not depend on the number of threads. */
    void multiply(const Unknowns &u, const Unknowns &u_rest, const Unknowns &y_rest, Unknowns &y) const;

    double memory() const { return 4. * (value.size() + column.size()); } ///< [bytes]

  private:
    std::vector<std::size_t>  start; ///< of each row, and the end
    std::vector<unsigned int> column;
    std::vector<float>        value; ///< blocks of nine by columns; then three zeros
    mutable Unknowns          change;
  };
} // namespace Voussoir

#endif
