// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_own_step_rock_h
#define voussoir_own_step_rock_h

#include <voussoir/foundation/explicit_rock.h>
#include <voussoir/rock/rock_patch.h>

namespace Voussoir
{
  /** The explicit rock at steps of its own, several in each of the dam. The feet of the dam are nodes of the
   * rock like others, with their own mass; in each step of the dam a constant force acts between dam and
   * rock, such that the feet of both are at the same place in the end (Support). The dam's time is half a
   * step of the rock ahead of that of the rock's displacements: there u + dt w/2 is the place of a foot, and
   * the force's work on the rock is force times the change of that place. Stable up to the rock's own
   * critical step, for any number of sub-steps: see doc/rock.md. */
  class OwnStepRock : public ExplicitRock, public Support
  {
  public:
    using ExplicitRock::ExplicitRock;

    Base        base() const override { return Base::led; }
    void        add_mass(Structure &) const override {} ///< the rock keeps its own
    std::string about_steps() const override;
    double      add_interface_mass(Structure &, const TimeGrid &) const override { return 0.; }
    Support    *support(Structure &structure) override;

    /** As ExplicitRock, and InputError where the artificial boundary is too near for as many sub-steps. */
    void check(const TimeGrid &grid, unsigned int steps_per_sample) const override;

    void    start(const GroundMotion &outcrop, const TimeGrid &grid, const Unknowns &u) override;
    void    advance(Unknowns &load) override;
    void    follow(const DynamicState &state) override;
    Vector3 base_velocity() const override { return predicted_velocity; }
    double  work_of_feet() const override { return account[3]; }

    std::vector<std::vector<double> *> state() override;

    const std::vector<unsigned int> &feet() const override { return standing.node; }
    unsigned int                     n_substeps() const override { return grid.substeps; }
    BlockSparseMatrix                compliance(unsigned int n) const override;
    Unknowns                         predict(unsigned int n, const Unknowns &at) override;
    void push(unsigned int n, const Unknowns &force, const Unknowns &place, double work) override;

  private:
    RayleighDamping damping() const;
    Unknowns        places() const;

    std::unique_ptr<RockPatch> patch;
    StandingNodes              standing;
    Vector3                    predicted_velocity{};
  };

  /** The one that the parameters choose: they say whether the rock has steps of its own. */
  std::unique_ptr<Foundation> make_explicit_rock(const FoundationSite &site);
} // namespace Voussoir

#endif
