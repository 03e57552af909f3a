// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_subdivide_h
#define voussoir_subdivide_h

#include <voussoir/mesh/mesh.h>

namespace Voussoir
{
  /** Cells of 8 corners (hexahedra) or 6 (wedges: triangle below, triangle above) and faces of 4 or 3
   * corners, in gmsh's order. */
  struct MixedMesh
  {
    struct Cell
    {
      std::vector<unsigned int> nodes;
      int                       volume;
      unsigned int              zone;
    };
    struct Face
    {
      std::vector<unsigned int> nodes;
      int                       surface;
    };
    std::vector<std::array<double, 3>> nodes;
    std::vector<Cell>                  cells;
    std::vector<Face>                  faces;
  };

  /** A hexahedron two of whose opposite edges have shrunk to points, as other programs write a wedge: its six
   * corners as a wedge. As it is, if it is none. */
  std::vector<unsigned int> without_double_corners(const std::vector<unsigned int> &hexahedron);

  /** Nodes, cells and faces of @p mixed, each divided at the middles of its edges, faces and cells: a
   * hexahedron into eight, a wedge into six hexahedra, a quadrilateral into four, a triangle into three
   * quadrilaterals. Neighbours fit. Doubled nodes of joints stay doubled. */
  void subdivide(const MixedMesh &mixed, HexMesh &mesh);
} // namespace Voussoir

#endif
