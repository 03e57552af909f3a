// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_base_force_h
#define voussoir_base_force_h

#include <voussoir/dam/base_part.h>
#include <voussoir/dam/dam.h>

namespace Voussoir
{
  using Wrench = std::array<double, 6>; ///< force along x, y, z [N], moment about these axes [N m]

  /** Base of a monolith, projected on its mean plane, or a part of the base. */
  struct BlockBase
  {
    int                    monolith = 0; ///< number of the monolith; 0: part of the base
    double                 area = 0.;    ///< of the projection on the mean plane [m^2]
    double                 uplift = 0.;  ///< uplift along the inward normal, or 0 [N]
    Vector3                centroid{};   ///< reference point of the moments [m]
    std::array<Vector3, 3> axes{}; ///< downstream in the plane; to the left bank; inward (upward) normal
  };

  /** Forces and moments of the foundation on a base, in the axes of the base. */
  struct BaseResultants
  {
    double  normal = 0.; ///< tension > 0 [N]
    double  shear[2];    ///< on the monolith, downstream and to the left bank [N]
    Vector3 moment{};    ///< about the three axes through the centroid [N m]
  };

  /** Returns the components of a wrench about the centroid in the axes of the base. */
  BaseResultants resultants(const BlockBase &base, const Wrench &wrench);

  /** Returns the safety against sliding (cohesion A + friction (compression - uplift)) / shear [-]. The
   * difference compression - uplift is not negative. Without shear the result is infinite.
   *
   * @param base, force base and its resultants
   * @param friction tan(phi) [-]
   * @param cohesion [Pa] */
  double sliding_safety(const BlockBase &base, const BaseResultants &force, double friction, double cohesion);

  /** Time step of the dam. dt = 0: static state. */
  struct StepOfDam
  {
    const Unknowns &before, &after;  ///< StaticState::elastic() at the start and the end of the step [m]
    const Unknowns &acceleration;    ///< mean absolute acceleration [m/s^2]; unused if dt = 0
    const Unknowns &joint_force;     ///< mean joint forces, three values per pair [N]
    Vector3         ground{};        ///< mean acceleration of fixed nodes [m/s^2]
    Vector3         base_velocity{}; ///< mean of DynamicState::base_velocity [m/s]
    double          dt = 0.;         ///< length of the step [s]

    /** Mean forces of acoustic water, per node of the model, or empty [N]. */
    std::vector<Vector3> water = {};

    Unknowns relaxation = {}; ///< DampingMemory::mean of the step, or empty [m]
    Unknowns lag = {};        ///< DampingMemory::lag, or empty [m]
  };

  /** Forces of the foundation on the bases of the monoliths. They are the residuals of the equations of
   * motion at the base nodes, with the elements, masses, damping and loads of one monolith. The results are
   * means over a time step and exact for the trapezoidal rule and leapfrog. In a step with reduced time step
   * they are exact except for its curvature. They are available for every foundation and for tied joints. A base
   * node of two monoliths contributes to each of them. Mass-proportional damping is a load on the concrete. The
   * staged weight acts by StagedWeight::reaction. With a BasePart there is one base: each node of the whole base
   * contributes the share of its force. */
  class BaseForces
  {
  public:
    /** Computes the coefficients of the sums.
     * @param dam dam; must outlive the object
     * @param joint_water pressure in each pair [Pa], or empty
     * @param part part of the base, instead of the bases of the monoliths; null: the monoliths. It is not used
     * later */
    explicit BaseForces(Dam &dam, const std::vector<double> &joint_water = {},
                        const BasePart *part = nullptr);

    /** Returns the bases by ascending number of the monolith. */
    const std::vector<BlockBase> &bases() const { return of_block; }

    /** Returns the compression of each base by the water in base joints [N], which is a part of its force.
     * @param pressure in each pair [Pa], or empty */
    std::vector<double> uplift_by(const std::vector<double> &pressure) const;

    /** Returns the wrench on each base, about its centroid. */
    std::vector<Wrench> of(const StepOfDam &step) const;

  private:
    /** Wrench as a linear function of the values at some nodes. */
    struct NodalSum
    {
      std::vector<unsigned int>           node; ///< free nodes
      std::vector<std::array<double, 18>> part; ///< 6 x 3 coefficients of each node
    };
    /** Pair with one side on the foundation. Its force acts on the foundation. */
    struct LonePair
    {
      unsigned int pair, block;
      double       sign;
    };
    void         find_bases();
    unsigned int block_of(int monolith) const;
    void         find_supports();
    void         add_cells(Structure &whole);
    void         add_loads(Structure &whole);
    void         add_masses(const Structure &whole);
    void         add_staged_weight();
    void         find_lone_pairs(const std::vector<double> &joint_water, const BasePart *part);
    void         add_crack_water(const Pair &pair, double force);

    const Dam             &dam;
    SolidModel            &model;
    std::vector<BlockBase> of_block;
    std::vector<NodalSum>  stiffness, mass;
    std::vector<NodalSum>  zones; ///< stiffness for StepOfDam::relaxation minus #stiffness, of Damping::zones
    std::vector<std::array<double, 18>> held_mass; ///< of fixed nodes
    std::vector<Wrench>                 constant;  ///< of the loads
    std::vector<unsigned int>           equation;  ///< of the nodes of the model in the dam
    std::vector<unsigned int>           block;     ///< base of each node of the model, or rigid_ground
    std::vector<double>                 share;     ///< of the force at each node of the model on its base [-]
    std::vector<LonePair>               lone;
    std::vector<double>                 water; ///< force of the water in each lone pair [N]
  };
} // namespace Voussoir

#endif
