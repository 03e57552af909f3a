// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_triangulation_h
#define voussoir_triangulation_h

#include <deal.II/grid/tria.h>

#include <voussoir/mesh/mesh.h>

namespace Voussoir
{
  /** Creates the deal.II triangulation of some cells of a mesh. It keeps the order of the cells and of their
   * nodes. Material ids are volumes, boundary ids are surfaces (0: none).
   * @param mesh nodes, cells and faces
   * @param cells indices of the cells
   * @param triangulation receives the result
   *
   * Returns the mesh node of each vertex. */
  std::vector<unsigned int> make_triangulation(const HexMesh &mesh, const std::vector<unsigned int> &cells,
                                               dealii::Triangulation<3> &triangulation);
} // namespace Voussoir

#endif
