// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_arch_rows_h
#define voussoir_arch_rows_h

#include <array>
#include <vector>

namespace Voussoir
{
  /** Columns of nodes of an arch dam, from the right bank to the left. */
  struct ArchColumns
  {
    std::vector<double>              s;        ///< place along the crest, from the crown to the left [m]
    std::vector<int>                 monolith; ///< of the elements between two columns
    std::vector<std::vector<double>> base;     ///< height of the base of each column in each layer [m]
    double                           top;      ///< height of the crest [m]
  };

  /** Mesh of an arch dam in the plane of s and z. The layers through the dam make its quadrilaterals hexahedra. */
  struct ArchPlane
  {
    struct Quad
    {
      std::array<unsigned int, 4> nodes;      ///< counter-clockwise, from the lower right bank
      int                         volume;     ///< physical id
      unsigned int                middle = 0; ///< middle column of its wide template; 0: in none
    };
    std::vector<double>                    s;       ///< of each node [m]
    std::vector<std::vector<double>>       z;       ///< heights of each node in the layers [m]
    std::vector<std::vector<unsigned int>> columns; ///< nodes of each column, from the base to the crest
    std::vector<Quad>                      quads;   ///< from the right bank to the left
  };

  /** Returns a mesh with rows of about the height h = (height of the dam)/@p n_up, counted from the crest.
   *
   * The numbers of rows have the parity of n_up and change by 0 or 2 from column to column. The lowest three rows of a
   * column are equal and take what rows of h leave. Where the number falls, a template over two columns of elements of
   * one monolith (wide) or over one (narrow) ends two rows.
   * @param refused true for columns that cannot be the middle of a wide template */
  ArchPlane rows_from_crest(const ArchColumns &columns, int n_up, const std::vector<bool> &refused);
} // namespace Voussoir

#endif
