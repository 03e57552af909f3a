#ifndef voussoir_rock_model_h
#define voussoir_rock_model_h

#include <voussoir/mesh/mesh.h>
#include <voussoir/rock/transmitting_boundary.h>
#include <voussoir/solid/material.h>

#include <map>

namespace Voussoir
{
  /** How the rock is discretised. */
  struct RockParameters
  {
    std::map<int, Material> materials; ///< by volume id; cells of other volumes do not belong to the region

    /** Nodal (Gauss-Lobatto) quadrature of the stiffness in all cells, or in that many layers at the
     * artificial boundary, and 2x2x2 Gauss points elsewhere. Gauss points at a transmitting boundary are
     * unstable (Zhang, Liao and Xie 2015, Chin. J. Geophys. 58(10)). */
    bool         nodal_everywhere = false;
    unsigned int nodal_layers = 6;

    std::array<double, 3> centre = {
        {0., 0., 0.}}; ///< where the scattered waves come from: base of the dam [m]
  };

  /** Wave speeds [m/s]. */
  double p_wave_speed(const Material &material);
  double s_wave_speed(const Material &material);

  /** A face of the artificial boundary. */
  struct BoundaryFace
  {
    std::array<unsigned int, 4> nodes;
    Vector3                     normal; ///< outward
    double                      area;   ///< [m^2]
    Material                    material;
  };

  /** A vertical grid line on the artificial boundary, from its foot to the ground surface. */
  struct RockColumn
  {
    std::vector<unsigned int> nodes;    ///< of the region
    std::vector<double>       z;        ///< of the nodes, ascending [m]
    std::vector<Material>     material; ///< between the nodes
  };

  constexpr unsigned int no_node = static_cast<unsigned int>(-1);

  /** The finite element model of the rock. Node numbers are the region's own unless said otherwise. */
  struct RockModel
  {
    std::vector<unsigned int>          node;      ///< of each mesh node, no_node if it is not in the rock
    std::vector<std::array<double, 3>> points;    ///< places of the nodes [m]
    BlockSparseMatrix                  stiffness; ///< [N/m]
    std::vector<double>                mass;      ///< lumped, of each node [kg]
    std::vector<unsigned int>          layer;     ///< of each mesh cell from the artificial boundary, from 1
    std::vector<BoundaryLine>          lines;     ///< one for each node of the artificial boundary
    std::vector<BoundaryFace>          faces;     ///< of the artificial boundary
    std::vector<RockColumn>            columns;   ///< along side faces; at least one

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
   * Lines: side faces come before the bottom, and those across x before those across y, so a node on an edge
   * has the line that is normal to the first of its faces. InputError if the grid has no lines. */
  RockModel make_rock_model(const HexMesh &mesh, const RockParameters &parameters,
                            const std::vector<unsigned int> &master = {});

  /** For a mesh of one layer of cells: each node tied to the one at the same place but for @p direction. */
  std::vector<unsigned int> tie_layer(const HexMesh &mesh, unsigned int direction);

  /** One layer of cells behind the part of the artificial boundary of @p mesh that faces @p sense times
   * @p direction (0 = x, 1 = y): the section through the rock there, with artificial boundary where the other
   * artificial faces meet it. Empty if there is no such part. */
  HexMesh extruded_section(const HexMesh &mesh, const RockParameters &parameters, unsigned int direction,
                           int sense);

  /** Lysmer's dashpots (rho c A) on the artificial boundary, with springs factor G/r A unless the factors
   * are zero (Liu, Du and Yan 2006: 4/3 normal, 2/3 tangential in three dimensions). */
  std::vector<Dashpot> viscous_boundary(const RockModel &model, const std::array<double, 3> &centre,
                                        double normal_spring, double tangential_spring);
} // namespace Voussoir

#endif
