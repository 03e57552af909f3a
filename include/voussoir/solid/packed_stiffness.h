// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_packed_stiffness_h
#define voussoir_packed_stiffness_h

#include <voussoir/solid/structure.h>

namespace Voussoir
{
  /** Stiffness matrix of a structure with its blocks by columns, for products with wide vectors. */
  class PackedStiffness
  {
  public:
    explicit PackedStiffness(const Structure &structure);

    /** Sets y = K u, three values per node [N]. The result does not depend on the number of threads. */
    void multiply(const Unknowns &u, Unknowns &y) const;

    double memory() const { return 8. * value.size() + 4. * column.size(); } ///< [bytes]

  private:
    std::vector<std::size_t>  start; ///< of each row, and the end
    std::vector<unsigned int> column;
    std::vector<double>       value; ///< blocks of nine by columns; then three zeros
  };
} // namespace Voussoir

#endif
