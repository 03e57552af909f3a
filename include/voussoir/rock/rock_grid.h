// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_grid_h
#define voussoir_rock_grid_h

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/tria.h>

#include <voussoir/base/tensor3.h>
#include <voussoir/mesh/mesh.h>
#include <voussoir/rock/rock_parameters.h>

#include <cmath>

namespace Voussoir
{
  /** The rock as deal.II's mesh, which is needed only while a RockModel is made of it. */
  struct RockGrid
  {
    using Cell = dealii::DoFHandler<3>::active_cell_iterator;

    /** The cells of @p mesh whose volumes have a material. @p master: mesh nodes with the same one are one
     * node of the region; empty if there are none. */
    RockGrid(const HexMesh &mesh, const RockParameters &parameters, const std::vector<unsigned int> &master);

    /** Node of the region at corner @p v of a cell, in deal.II's order of corners. */
    unsigned int node(const Cell &cell, const unsigned int v) const
    {
      return node_of_dof[cell->vertex_dof_index(v, 0)];
    }

    unsigned int n_nodes() const { return static_cast<unsigned int>(points.size()); }

    dealii::Triangulation<3>  triangulation; ///< material ids are volumes, boundary ids surfaces
    dealii::FE_Q<3>           fe;
    dealii::DoFHandler<3>     dof_handler; ///< its degrees of freedom are the vertices, in the mesh's order
    std::vector<unsigned int> mesh_node;   ///< of each degree of freedom
    std::vector<unsigned int> node_of_dof; ///< of the region
    std::vector<Vector3>      points;      ///< of the region's nodes [m]
  };

  /** A face of the artificial boundary. */
  struct ArtificialFace
  {
    RockGrid::Cell              cell;
    unsigned int                face;    ///< of the cell
    std::array<unsigned int, 4> corners; ///< of the cell, counter-clockwise seen from outside
    Vector3                     normal;  ///< outward
    double                      area;    ///< [m^2]

    unsigned int rank() const ///< in the order in which lines are chosen
    {
      return std::abs(normal[2]) > .7 ? 2 : std::abs(normal[1]) > .7 ? 1 : 0;
    }
  };

  /** The faces of the artificial boundary: those across x first, the bottom last. */
  std::vector<ArtificialFace> artificial_faces(const RockGrid &grid);

  /** A grid line from the artificial boundary inward: edges one behind the other, each from a cell of the
   * stack of cells behind a face. */
  struct InwardLine
  {
    std::vector<unsigned int>     nodes;
    std::vector<dealii::Point<3>> places; ///< of the nodes [m]
    std::vector<RockGrid::Cell>   cells;  ///< between the nodes
  };

  /** The line from @p corner of the cell behind @p face, one of the face's; at most @p n nodes of it. */
  InwardLine inward_line(const RockGrid &grid, const ArtificialFace &face, unsigned int corner,
                         std::size_t n);

  /** Of each active cell: is it one of the @p n_layers of cells at the artificial boundary? */
  std::vector<bool> cells_at_boundary(const RockGrid &grid, const std::vector<ArtificialFace> &faces,
                                      unsigned int n_layers);

  /** Of each active cell: is it one of the @p n_layers of cells about the surfaces PhysicalId::base? */
  std::vector<bool> cells_at_dam(const RockGrid &grid, unsigned int n_layers);
} // namespace Voussoir

#endif
