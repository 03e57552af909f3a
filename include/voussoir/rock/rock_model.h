// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_model_h
#define voussoir_rock_model_h

#include <voussoir/mesh/mesh.h>
#include <voussoir/rock/rock_operator.h>
#include <voussoir/rock/rock_parameters.h>
#include <voussoir/solid/structure.h>

namespace Voussoir
{
  /** Marker for "no node" or "no column". */
  constexpr unsigned int no_node = static_cast<unsigned int>(-1);

  /** Grid line from the artificial boundary inward. The motion of the first node follows from that of the
   * other nodes. Scattered waves come from a source point (RockParameters::centre). */
  struct BoundaryLine
  {
    std::vector<unsigned int> nodes;              ///< nodes of the region; nodes[0] is on the boundary
    std::vector<double>       position;           ///< distance of each node from nodes[0] along the line [m]
    double                    c_p = 0., c_s = 0.; ///< P and S wave speeds of the rock at nodes[0] [m/s]
    double distance = 0.; ///< distance of nodes[0] from the source [m]; tied nodes: the largest one
  };

  /** Face of a cell on the artificial boundary, with the rock behind it. */
  struct BoundaryFace
  {
    std::array<unsigned int, 4> nodes;    ///< nodes of the region, counter-clockwise seen from outside
    Vector3                     normal;   ///< outward unit normal [-]
    double                      area;     ///< [m^2]
    int                         volume;   ///< volume id of the cell behind the face
    Material                    material; ///< material of this cell
  };

  /** Vertical grid line on a side face of the artificial boundary, from the bottom to the ground surface. */
  struct RockColumn
  {
    std::vector<unsigned int> nodes;    ///< nodes of the region, from below
    std::vector<double>       z;        ///< heights of the nodes, ascending [m]
    std::vector<Material>     material; ///< materials between the nodes, one fewer than nodes
  };

  /** Finite element model of the rock. The nodes are numbered in the order in which the mesh numbers the
   * nodes of the rock. */
  struct RockModel
  {
    std::vector<unsigned int>          node;   ///< node of the region per mesh node; no_node outside the rock
    std::vector<std::array<double, 3>> points; ///< positions of the nodes [m]
    BlockSparseMatrix                  stiffness; ///< stiffness matrix of the region [N/m]
    std::vector<NodalCell> nodal_cells;        ///< cells with nodal quadrature, except those with tied nodes
    std::vector<bool>      in_other_cell;      ///< per node: whether it belongs to another cell, too
    unsigned int           n_cells_at_dam = 0; ///< number of cells in RockParameters::layers_at_dam
    unsigned int           n_nodal_at_dam =
        0; ///< number of these cells that lie in the layers at the artificial boundary
    double largest_crossing =
        0.; ///< time of a shear wave along the longest edge of a cell, of 95 % of the cells [s]
    std::vector<double>       mass;    ///< lumped mass of each node [kg]
    std::vector<BoundaryLine> lines;   ///< one line per node of the artificial boundary
    std::vector<BoundaryFace> faces;   ///< faces of the artificial boundary
    std::vector<RockColumn>   columns; ///< columns of the side faces; at least one

    /** Position in the free field of a line. Lines of side faces have a column and the level of their
     * boundary node in it. Lines of the bottom have the column no_node. */
    struct Place
    {
      unsigned int column, level;
    };
    std::vector<Place> place; ///< one per line
  };

  /** Creates the model of the cells of @p mesh whose volumes have a material.
   * @param mesh mesh with surfaces of the artificial boundary
   * @param parameters materials and quadrature
   * @param master master of each mesh node. Nodes with the same master move together; a two-dimensional
   * problem is one layer of cells with tied nodes. Empty: no tied nodes.
   *
   * The elements are trilinear elements of deal.II. Masses are row sums of the mass matrix of
   * 2x2x2 Gauss points.
   *
   * Lines: faces across x have priority over faces across y, and these over the bottom. A node on an edge has
   * the line normal to the face of highest priority. If several stacks of cells begin at the same edge, lines
   * and columns follow the longest stack. Between two rocks, lines and columns have the mean moduli and
   * densities, weighted by the areas of the faces of the stacks. */
  RockModel make_rock_model(const HexMesh &mesh, const RockParameters &parameters,
                            const std::vector<unsigned int> &master = {});

  /** Creates the stiffness operator of a model. @p kernel: see nodal_kernel(). */
  RockOperator make_operator(const RockModel &model, NodalKernel kernel = nodal_kernel());

  /** Creates the part of the stiffness operator for this MPI process. @p split: receives the nodes that the
   * parts require. */
  RockOperator make_operator(const RockModel &model, RockSplit &split);
} // namespace Voussoir

#endif
