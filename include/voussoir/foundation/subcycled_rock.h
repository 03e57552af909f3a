// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_subcycled_rock_h
#define voussoir_subcycled_rock_h

#include <voussoir/foundation/explicit_rock.h>
#include <voussoir/rock/rock_patch.h>

namespace Voussoir
{
  /** Subcycled explicit rock: several rock time steps per time step of the dam, coupled by Support. The base
   * nodes are ordinary nodes of the rock with their own mass. In each time step of the dam a constant force
   * acts between dam and rock. It makes the displacements of both equal at the end of the step.
   *
   * The time of the dam is half a rock time step later than the time of the rock displacements u. At the time
   * of the dam a base node has the displacement u + dt w/2, with the velocity w half a step later. The work
   * of the force on the rock is the force times the change of this displacement. The coupling is stable up to
   * the critical time step of the rock, for any number of substeps (doc/rock.md). */
  class SubcycledRock : public ExplicitRock, public Support
  {
  public:
    using ExplicitRock::ExplicitRock;

    Base        base() const override { return Base::coupled; }
    std::string about_steps() const override;

    /** Returns this object. Marks the base nodes as interface nodes of their bodies. */
    Support *support(Structure &structure) override;

    /** Checks as ExplicitRock does. Throws InputError, too, if there are fewer element layers between base
     * and artificial boundary than substeps. */
    void check(const TimeGrid &grid, unsigned int steps_per_sample) const override;

    // Neighbour: motion of the base.

    void start(const GroundMotion &outcrop, const TimeGrid &grid, const Unknowns &u) override;

    /** Predicts base_velocity(). The @p load is unchanged, because Support exchanges the forces. */
    void advance(Unknowns &load) override;

    /** Stores the mean velocity of the base nodes. */
    void    update_from_dam(const DynamicState &state) override;
    Vector3 base_velocity() const override { return predicted_velocity; }

    std::vector<std::vector<double> *> state() override;

    // Support: coupling in a time step. One substep is one time step of the rock.

    const std::vector<unsigned int> &base_nodes() const override { return dam_nodes.node; }
    unsigned int                     n_substeps() const override { return grid.substeps; }
    BlockSparseMatrix                compliance(unsigned int n) const override;

    /** Predicts with RockPatch from the motion of the rock; @p at is unused. Must be called by all ranks. */
    Unknowns predict(unsigned int n, double time, const Unknowns &at) override;

    /** Advances the rock by @p n time steps under the opposite forces. Must be called by all ranks. */
    void advance(unsigned int n, const Unknowns &force, const Unknowns &place, double work) override;

  private:
    RockDamping damping() const; ///< returns the damping of the rock

    /** Returns the displacements of the base nodes at the time of the dam, three values each, without the
     * static ones [m]. */
    Unknowns places() const;

    // From start() on.
    std::unique_ptr<RockPatch> patch;     ///< rock near the base, for predict()
    DamNodes                   dam_nodes; ///< dam nodes on the rock
    Unknowns                   rest;      ///< static displacement of the dam nodes, three values each [m]
    Vector3                    predicted_velocity{}; ///< base_velocity() of this step [m/s]

    // Mean of the base nodes at the end of the last step: x, y, z. Vectors for state().
    Unknowns mean_v; ///< velocity [m/s]
    Unknowns mean_a; ///< acceleration [m/s^2]
  };

  /** Creates SubcycledRock if FoundationParameters::is_subcycled(), otherwise PartitionedRock. */
  std::unique_ptr<Foundation> make_explicit_rock(const FoundationSite &site);
} // namespace Voussoir

#endif
