// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_base_force_h
#define voussoir_base_force_h

#include <voussoir/dam/dam.h>

namespace Voussoir
{
  using Wrench = std::array<double, 6>; ///< force along x, y, z [N], moment about them [N m]

  /** The base of a monolith, in its mean plane. */
  struct BlockBase
  {
    int                    monolith = 0; ///< its number
    double                 area = 0.;    ///< of its projection on the mean plane [m^2]
    double                 uplift = 0.;  ///< of the water under it along the inward normal, or 0 [N]
    Vector3                centroid{};   ///< the moments are about it [m]
    std::array<Vector3, 3> axes{}; ///< downstream in the plane; along the arch, to the left bank; inward
                                   ///< normal (upward). Right-handed
  };

  /** What the foundation does to a base: the wrench in its axes. */
  struct BaseResultants
  {
    double  normal = 0.; ///< tension > 0 [N]
    double  shear[2];    ///< on the monolith, downstream and to the left bank [N]
    Vector3 moment{};    ///< about the three axes through the centroid [N m]
  };
  BaseResultants resultants(const BlockBase &base, const Wrench &wrench);

  /** (cohesion A + friction (compression - uplift)) / shear; where no compression is left only the cohesion
   * holds. Infinite without shear. */
  double sliding_safety(const BlockBase &base, const BaseResultants &force, double friction, double cohesion);

  /** A step of the dam; at rest where dt is 0. */
  struct StepOfDam
  {
    const Unknowns &before, &after;  ///< displacements at its ends [m]
    const Unknowns &acceleration;    ///< mean, of the base, too [m/s^2]; unused at rest
    const Unknowns &joint_force;     ///< mean, 3 per pair [N]
    Vector3         ground{};        ///< mean acceleration of nodes that are held [m/s^2]
    Vector3         base_velocity{}; ///< mean: DynamicState::base_velocity [m/s]
    double          dt = 0.;         ///< [s]
  };

  /** The forces of the foundation on the bases of the monoliths, from the equations of motion of the nodes
   *  there: what the monolith's own cells, its mass, its damping and its share of the loads leave. Exact for
   * the discrete system, as means over a step (those of a step that was halved but for its curvature), for
   * any foundation, and whether the joints are tied or not; the foot of a joint, where two monoliths share a
   * node of the foundation, has each one's part. The mass-proportional damping counts as a load on the
   * concrete. The weight of monoliths that were staged is theirs alone. Nothing is solved: six sums over the
   * nodes of the lowest cells. */
  class BaseForces
  {
  public:
    /** @p joint_water: pressure in each pair [Pa], or empty. */
    explicit BaseForces(Dam &dam, const std::vector<double> &joint_water = {});

    const std::vector<BlockBase> &bases() const { return of_block; } ///< ascending in their numbers
    std::vector<Wrench>           of(const StepOfDam &step) const;   ///< about the centroids, one for each

  private:
    /** Force and moment, linear in what is given at some nodes. */
    struct NodalSum
    {
      std::vector<unsigned int>           node; ///< free node
      std::vector<std::array<double, 18>> part; ///< 6 x 3
    };
    /** A pair of which one side alone stands on the foundation: its force goes straight there. */
    struct LonePair
    {
      unsigned int pair, block;
      double       sign;
    };
    void         find_bases();
    unsigned int block_of(const dealii::DoFHandler<3>::active_cell_iterator &cell) const;
    void         find_supports();
    void         add_cells(Structure &whole);
    void         add_loads(Structure &whole);
    void         add_masses(const Structure &whole);
    void         add_staged_weight();
    void         find_lone_pairs(const std::vector<double> &joint_water);

    const Dam                          &dam;
    SolidModel                         &model;
    std::vector<BlockBase>              of_block;
    std::vector<NodalSum>               stiffness, mass;
    std::vector<std::array<double, 18>> held_mass; ///< of nodes that are held
    std::vector<Wrench>                 constant;  ///< of the loads
    std::vector<unsigned int>           equation;  ///< of the nodes of the model, as the dam has them
    std::vector<unsigned int> block; ///< per node of the model: whose support it is, or rigid_ground
    std::vector<LonePair>     lone;
    std::vector<double>       water; ///< force of the water in each lone pair [N]
  };
} // namespace Voussoir

#endif
