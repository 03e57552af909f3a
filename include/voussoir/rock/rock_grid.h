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
  /** Rock mesh as a deal.II triangulation. It exists only while a RockModel is built. */
  struct RockGrid
  {
    using Cell = dealii::DoFHandler<3>::active_cell_iterator;

    /** Creates the grid of the cells of @p mesh whose volumes have a material. @p master: master of each mesh
     * node. Mesh nodes with the same master become one node of the region. Empty: no tied nodes. */
    RockGrid(const HexMesh &mesh, const RockParameters &parameters, const std::vector<unsigned int> &master);

    /** Returns the node of the region at corner @p v of a cell, in the corner order of deal.II. */
    unsigned int node(const Cell &cell, const unsigned int v) const
    {
      return node_of_dof[cell->vertex_dof_index(v, 0)];
    }

    /** Returns the number of nodes of the region. */
    unsigned int n_nodes() const { return static_cast<unsigned int>(points.size()); }

    dealii::Triangulation<3>  triangulation; ///< material ids: volumes; boundary ids: surfaces of the mesh
    dealii::FE_Q<3>           fe;
    dealii::DoFHandler<3>     dof_handler; ///< one degree of freedom per vertex, in the order of the mesh
    std::vector<unsigned int> mesh_node;   ///< per degree of freedom
    std::vector<unsigned int> node_of_dof; ///< node of the region per degree of freedom
    std::vector<Vector3>      points;      ///< positions of the nodes of the region [m]
  };

  /** A face of the artificial boundary. */
  /** Face of a cell on the artificial boundary. */
  struct ArtificialFace
  {
    RockGrid::Cell              cell;    ///< cell behind the face
    unsigned int                face;    ///< number of the face in the cell
    std::array<unsigned int, 4> corners; ///< corners of the cell, counter-clockwise seen from outside
    Vector3                     normal;  ///< outward unit normal [-]
    double                      area;    ///< [m^2]

    unsigned int rank() const ///< priority of the face for grid lines: 0: across x, 1: across y, 2: bottom
    {
      return std::abs(normal[2]) > .7 ? 2 : std::abs(normal[1]) > .7 ? 1 : 0;
    }
  };

  /** Returns the faces of the artificial boundary in the order of ArtificialFace::rank(): first those across
   * x, last the bottom. */
  std::vector<ArtificialFace> artificial_faces(const RockGrid &grid);

  /** Grid line from the artificial boundary inward: consecutive edges of the stack of cells behind a face. */
  struct InwardLine
  {
    std::vector<unsigned int>     nodes;  ///< nodes of the region, from the boundary inward
    std::vector<dealii::Point<3>> places; ///< positions of the nodes [m]
    std::vector<RockGrid::Cell>   cells;  ///< cells between the nodes
  };

  /** Returns the line from @p corner of the cell behind @p face, with at most @p n nodes. The corner must lie
   * on the face. */
  InwardLine inward_line(const RockGrid &grid, const ArtificialFace &face, unsigned int corner,
                         std::size_t n);

  /** Returns for each active cell whether it lies in the @p n_layers of cells at the artificial boundary. */
  std::vector<bool> cells_at_boundary(const RockGrid &grid, const std::vector<ArtificialFace> &faces,
                                      unsigned int n_layers);

  /** Returns for each active cell whether it lies in the @p n_layers of cells around
   * the surfaces PhysicalId::base. */
  std::vector<bool> cells_at_dam(const RockGrid &grid, unsigned int n_layers);
} // namespace Voussoir

#endif
