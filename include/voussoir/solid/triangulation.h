// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_triangulation_h
#define voussoir_triangulation_h

#include <deal.II/grid/tria.h>

#include <voussoir/mesh/mesh.h>

namespace Voussoir
{
  /** Makes deal.II's mesh of the @p cells of @p mesh, in that order. Its vertices are their nodes, in the
   * order of the mesh; material ids are volumes, boundary ids surfaces (0 where a face is in none). Returns
   * the node of each vertex. */
  std::vector<unsigned int> make_triangulation(const HexMesh &mesh, const std::vector<unsigned int> &cells,
                                               dealii::Triangulation<3> &triangulation);
} // namespace Voussoir

#endif
