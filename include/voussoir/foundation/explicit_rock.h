// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_explicit_rock_h
#define voussoir_explicit_rock_h

#include <voussoir/foundation/feet.h>
#include <voussoir/foundation/foundation.h>
#include <voussoir/foundation/rock_statics.h>
#include <voussoir/rock/rock_region.h>

namespace Voussoir
{
  /** What the scene says of the rock; @p centre: of the dam's base [m], @p dt: of the rock [s]. */
  RockRegionParameters region_parameters(const FoundationParameters &p, const std::array<double, 3> &centre,
                                         double dt);

  /** InputError where the mesh has fewer layers of equal, straight elements than the artificial boundary
   * needs. @p source names the mesh. */
  void check_boundary_layers(const FoundationParameters &parameters, const HexMesh &mesh,
                             const std::string &source);

  /** The rock under and around the dam: explicit, in the element partition of Hughes and Liu (1978): the
   * nodes of the dam's base are the dam's, with the rock's mass lumped to them; the rock's elements act on
   * them with the forces of their predicted motion, u + dt v + dt^2/4 a. Displacements of the rock are those
   * of the earthquake; the static state is superposed.
   *
   *  With m substeps (and "Foundation/Coupling" = partition; else: OwnStepRock) the rock makes m steps in one
   * of the dam: the feet go evenly from one prediction to the next (Belytschko, Yen and Mullen 1979), and the
   * dam feels the force at the end. Predictions over so long a step make feet unstable that are lighter than
   * the rock's stiffness there asks; so for m > 1 each foot carries in addition the mass k dt^2/2, k bounding
   * the rock's stiffness between the feet: an error in the order of dt^2, whose size is in doc/rock.md. For m
   * > 2 slow growth is left, which stiffness-proportional damping of 0.15 steps of the rock suppresses;
   * check() asks for it. */
  class ExplicitRock : public Foundation
  {
  public:
    /** @p site: with the mesh of dam and rock. Throws InputError for a mesh that the boundary or the program
     * cannot use. */
    explicit ExplicitRock(const FoundationSite &site);

    Base base() const override { return Base::tied; }
    bool uses_rock() const override { return true; }
    bool moves_base() const override { return false; }
    bool resumes_longer_only() const override { return true; }

    void        add_stiffness(const SolidModel &dam, Structure &structure) override; ///< none: finds the feet
    void        add_mass(Structure &structure) const override; ///< half of it each where two monoliths stand
    void        report(Log &log, const TimeGrid &grid) const override;
    std::string about_steps() const override;
    void        add_to_summary(Json &summary, const TimeGrid &grid) const override;

    /** When the rising waves, S, S, P, are at the lowest foot, if they enter at t = 0 [s]. The P waves enter
     * later by the difference. */
    Vector3 arrival() const;
    double  delay() const override { return arrival()[0]; }

    unsigned int n_nodes() const { return static_cast<unsigned int>(model.points.size()); }
    double       critical_time_step() const { return dt_critical; } ///< of the rock [s]

    Unknowns      static_springs(const Structure &structure) const override;
    ContactResult settle(const DamSolve &solve, const Unknowns &springs, const Unknowns &u, Unknowns &load,
                         Log &log) override;

    /** InputError for a step above the critical one, and for what would become unstable with the steps
     * of the @p grid: an artificial boundary with lines too short, waves too fast, Gauss points, or too near
     * the base; a high Poisson's ratio, or more than two substeps, without enough damping. */
    void check(const TimeGrid &grid, unsigned int steps_per_sample) const override;

    double  add_interface_mass(Structure &structure, const TimeGrid &grid) const override;
    void    start(const GroundMotion &outcrop, const TimeGrid &grid, const Unknowns &u) override;
    void    advance(Unknowns &load) override;
    void    follow(const DynamicState &state) override;
    Vector3 base_velocity() const override;
    double  seconds() const override { return seconds_advancing; }
    double  work() const override { return work_advancing; }

    std::vector<std::pair<std::string, double>> energies() const override;
    double                                      balance_error() const override;
    void                                        report_balance(Log &log) const override;
    std::vector<std::vector<double> *>          state() override;
    void                                        collect() override { region->collect(); }

    void        watch(const GroundMotion &motion, const WatchBounds &bounds) override;
    std::string trouble_of_energy() const override;
    std::string trouble_of_motion() const override;
    std::string remedies() const override;

    /** Energies of the rock, half a step of its own before the dam's time, after start() [J]. */
    RegionEnergy energy() const { return region->energy(); }

    /** Work of the rock on the feet so far, as the dam counts it, and of the feet on the rock [J]: they add
     * up to what the coupling made. */
    double         work_on_dam() const { return account[0]; }
    virtual double work_of_feet() const { return energy().prescribed; }

  protected:
    /** @p near_feet: nodes that the rank which looks @p ahead asks for, besides the feet, which all do. */
    void                      make_rock(const GroundMotion &outcrop, const TimeGrid &steps, double delay,
                                        const std::vector<unsigned int> &near_feet = {});
    void                      report_layers(Log &log, unsigned int nodal_layers) const;
    void                      keep_account(double time);
    std::vector<unsigned int> feet_of_rock() const; ///< nodes of the region

  private:
    void     check_stability(const TimeGrid &grid) const;
    void     solve_rock(const Unknowns &r, double part, Unknowns &u_base, Log &log);
    Unknowns with_springs(const Unknowns &external, const Unknowns &springs, const Unknowns &base,
                          const Unknowns &r) const;
    double   add_slack(const Unknowns &springs, const Unknowns &u, const Unknowns &base, Unknowns &r) const;

  protected:
    const FoundationParameters      parameters;
    HexMesh                         mesh;
    const std::string               source;
    const bool                      incompatible_modes; ///< of the dam's elements
    std::array<double, 3>           centre{}; ///< of the dam's base: scattered waves come from there [m]
    RockModel                       model;
    std::vector<Foot>               foot;
    std::unique_ptr<ExplicitRegion> region;
    std::unique_ptr<RockStatics>    statics; ///< while the static state is looked for
    unsigned int                    n_settled = 0;
    unsigned int                    ahead = 0; ///< rank that has most nodes near the feet
    TimeGrid                        grid;
    double                          dt_critical = 0.;         ///< for the rock [s]
    double                          seconds_advancing = 0.;   ///< of wall time [s]
    double                          work_advancing = 0.;      ///< of processor time, without messages [s]
    Unknowns                        rest;                     ///< of the feet [m]
    Unknowns                        u_feet, v, a;             ///< of the feet
    Unknowns                        force, force_before;      ///< of the rock's elements on them [N]
    Unknowns                        u_predicted, v_predicted; ///< for the end of the step
    std::vector<double> account = {0., 0., 0.}; ///< work on the dam, largest energy, largest imbalance [J]
    WatchBounds         bounds;
    double              energy_bound = 0.; ///< that the rock may take in [J]
  };
} // namespace Voussoir

#endif
