// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_partitioned_rock_h
#define voussoir_partitioned_rock_h

#include <voussoir/foundation/explicit_rock.h>

namespace Voussoir
{
  /** Explicit rock with the time step of the dam, coupled by the element partition of Hughes and Liu (1978).
   * The base nodes belong to the dam and carry the lumped mass of the rock. The forces of the rock on these
   * nodes follow from their predicted displacement u + dt v + dt^2/4 a. */
  class PartitionedRock : public ExplicitRock
  {
  public:
    using ExplicitRock::ExplicitRock;

    Base        base() const override { return Base::tied; }
    std::string about_steps() const override;

    /** Adds the rock mass of each base node, in equal parts to the dam nodes at its position. */
    void add_mass(Structure &structure) const override;

    void start(const GroundMotion &outcrop, const TimeGrid &grid, const Unknowns &u) override;

    /** Predicts the motion of the base nodes at the end of the step, advances the rock with it and adds the
     * forces of the rock to the nodal loads @p load [N]. */
    void    advance(Unknowns &load) override;
    void    update_from_dam(const DynamicState &state) override;
    Vector3 base_velocity() const override;

    std::vector<std::vector<double> *> state() override;

  protected:
    // Three values per base node, at the time of the dam; displacements without the static ones.
    Unknowns rest;         ///< static displacement: mean of the dam nodes on each base node [m]
    Unknowns u_base;       ///< displacement at the end of the last step [m]
    Unknowns v;            ///< velocity at the end of the last step [m/s]
    Unknowns a;            ///< acceleration at the end of the last step [m/s^2]
    Unknowns u_predicted;  ///< displacement that advance() predicted for the end of the step [m]
    Unknowns v_predicted;  ///< velocity that advance() predicted for the end of the step [m/s]
    Unknowns force;        ///< force of the rock on the base nodes in this step [N]
    Unknowns force_before; ///< the same in the previous step [N]
  };

  /** Explicit rock under an explicit dam: both take the same steps. The base nodes carry the masses of both, and the
   * forces of the rock on these nodes follow from their displacement, so the whole is one leapfrog rule. It is stable
   * below the smaller one of the critical steps of dam and rock (Rayleigh quotient). */
  class CommonStepRock : public PartitionedRock, public StepNeighbour
  {
  public:
    using PartitionedRock::PartitionedRock;

    StepNeighbour *step_neighbour(Structure &) override { return this; }
    void           advance(Unknowns &) override {} ///< StepNeighbour::advance() does
    void           update_from_dam(const DynamicState &state) override { finish_step(state.time); }
    Vector3        base_velocity() const override { return {}; }

    void add_forces(Unknowns &load) const override;
    void advance(const Unknowns &u, const Unknowns &w) override;
  };
} // namespace Voussoir

#endif
