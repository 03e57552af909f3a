// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_model_h
#define voussoir_rock_model_h

#include <voussoir/mesh/mesh.h>
#include <voussoir/rock/rock_operator.h>
#include <voussoir/rock/rock_parameters.h>
#include <voussoir/solid/structure.h>

namespace Voussoir
{
  constexpr unsigned int no_node = static_cast<unsigned int>(-1);

  /** A grid line from the artificial boundary inward. The first node's motion follows from the others'. The
   * source is where the scattered waves come from (RockParameters::centre). */
  struct BoundaryLine
  {
    std::vector<unsigned int> nodes;              ///< of the region; nodes[0] lies on the boundary
    std::vector<double>       position;           ///< of the nodes, distance from nodes[0] along the line [m]
    double                    c_p = 0., c_s = 0.; ///< wave speeds of the rock at nodes[0] [m/s]
    double                    distance = 0.;      ///< of nodes[0], tied: the farthest, from the source [m]
  };

  /** A face of the artificial boundary. */
  struct BoundaryFace
  {
    std::array<unsigned int, 4> nodes;  ///< counter-clockwise seen from outside
    Vector3                     normal; ///< outward
    double                      area;   ///< [m^2]
    int                         volume; ///< of the cell behind it
    Material                    material;
  };

  /** A vertical grid line on the artificial boundary, from its foot to the ground surface. */
  struct RockColumn
  {
    std::vector<unsigned int> nodes;    ///< of the region
    std::vector<double>       z;        ///< of the nodes, ascending [m]
    std::vector<Material>     material; ///< between the nodes
  };

  /** The finite element model of the rock. Nodes are numbered in the mesh's order of those of the rock. */
  struct RockModel
  {
    std::vector<unsigned int>          node;      ///< of each mesh node, no_node if it is not in the rock
    std::vector<std::array<double, 3>> points;    ///< places of the nodes [m]
    BlockSparseMatrix                  stiffness; ///< [N/m]
    std::vector<NodalCell> nodal_cells;        ///< those with nodal quadrature, unless their nodes are tied
    std::vector<bool>      in_other_cell;      ///< of each node: is it one of a cell of another kind?
    unsigned int           n_cells_at_dam = 0; ///< in RockParameters::layers_at_dam
    unsigned int           n_nodal_at_dam = 0; ///< of these, those in the layers at the artificial boundary
    std::vector<double>    mass;               ///< lumped, of each node [kg]
    std::vector<BoundaryLine> lines;           ///< one for each node of the artificial boundary
    std::vector<BoundaryFace> faces;           ///< of the artificial boundary
    std::vector<RockColumn>   columns;         ///< along side faces; at least one

    /** For each line, where its free field is to be taken: side lines have a column and the place of their
     * node in it; lines of the bottom have column no_node. */
    struct Place
    {
      unsigned int column, level;
    };
    std::vector<Place> place;
  };

  /** Model of the cells of @p mesh whose volumes have a material. @p master: mesh nodes with the same master
   * move as one (a two-dimensional problem is one layer of cells, tied); empty if there are none.
   *
   * Trilinear elements of deal.II; masses are row sums of 2x2x2 Gauss points.
   *
   * Lines: side faces come before the bottom, and those across x before those across y, so a node on an edge
   * has the line that is normal to the first of its faces. Of stacks of cells that begin with the same edge,
   * lines and columns follow the longest. Between two rocks they have the mean of their moduli and densities,
   * by the areas of the faces behind which the stacks lie. */
  RockModel make_rock_model(const HexMesh &mesh, const RockParameters &parameters,
                            const std::vector<unsigned int> &master = {});

  /** For products with the model's stiffness; @p kernel: of nodal_kernel(). */
  RockOperator make_operator(const RockModel &model, NodalKernel kernel = nodal_kernel());

  /** This rank's part of it; @p split: receives what the parts ask for. */
  RockOperator make_operator(const RockModel &model, RockSplit &split);
} // namespace Voussoir

#endif
