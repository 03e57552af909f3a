// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_subdivide_h
#define voussoir_subdivide_h

#include <voussoir/mesh/mesh.h>

namespace Voussoir
{
  /** Mesh of hexahedra (8 corners) and wedges (6 corners: lower and upper triangle), with faces of 4 or 3
   * corners. The corners have the order of gmsh. */
  struct MixedMesh
  {
    struct Cell
    {
      std::vector<unsigned int> nodes;
      int                       volume; ///< physical id
      unsigned int              zone;   ///< as in HexMesh
    };
    struct Face
    {
      std::vector<unsigned int> nodes;
      int                       surface; ///< physical id
    };
    std::vector<std::array<double, 3>> nodes;
    std::vector<Cell>                  cells;
    std::vector<Face>                  faces;
  };

  /** Returns the six corners of a wedge that is written as a hexahedron with two collapsed edges, as some
   * programs do. Returns other cells unchanged. */
  std::vector<unsigned int> without_double_corners(const std::vector<unsigned int> &hexahedron);

  /** Divides all cells and faces of @p mixed at the midpoints of their edges, faces and cells.
   *
   * A hexahedron becomes eight hexahedra, a wedge six. A quadrilateral becomes four quadrilaterals, a
   * triangle three. The mesh stays conforming, and the doubled nodes of joints stay doubled.
   *
   * @param mixed mesh to divide
   * @param mesh receives the nodes; cells and faces are appended */
  void subdivide(const MixedMesh &mixed, HexMesh &mesh);
} // namespace Voussoir

#endif
