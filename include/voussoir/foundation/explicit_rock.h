// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_explicit_rock_h
#define voussoir_explicit_rock_h

#include <voussoir/foundation/base_nodes.h>
#include <voussoir/foundation/foundation.h>
#include <voussoir/foundation/rock_monitor.h>
#include <voussoir/foundation/rock_static_state.h>
#include <voussoir/rock/rock_region.h>

namespace Voussoir
{
  /** Elastic rock with mass and explicit time integration, coupled by the element partition of Hughes and Liu
   * (1978). The base nodes belong to the dam and carry the lumped mass of the rock. The forces of the rock on
   * these nodes follow from their predicted displacement u + dt v + dt^2/4 a. Displacements of the rock are
   * those of the earthquake only. The static displacements are superposed.
   * Dam and rock have the same time step. For other couplings see SubcycledRock. */
  class ExplicitRock : public Foundation
  {
  public:
    /** Stores the parameters and the mesh of @p site. Throws InputError if the element degree is not 1. */
    explicit ExplicitRock(const FoundationSite &site);

    Base base() const override { return Base::tied; }
    bool uses_rock() const override { return true; }
    bool moves_base() const override { return false; }
    bool resumes_longer_only() const override { return true; }

    /** Finds the base nodes, assembles the rock and computes the critical time step. The stiffness of the
     * @p structure is unchanged. Throws InputError if the artificial boundary cannot use the mesh. */
    void add_stiffness(const SolidModel &dam, Structure &structure) override;

    /** Adds the rock mass of each base node, in equal parts to the dam nodes at its position. */
    void add_mass(Structure &structure) const override;

    void        report(Log &log, const TimeGrid &grid) const override;
    std::string about_steps() const override;
    void        add_to_summary(Json &summary, const TimeGrid &grid) const override;

    /** Returns the travel times of the S waves (x, y) and the P wave (z) from the bottom of the rock to the
     * lowest base node [s]. The P wave enters later, so that all components arrive at the same time. */
    Vector3 arrival() const;
    double  delay() const override { return arrival()[0]; }

    /** Returns the critical time step of the rock [s]. */
    double critical_time_step() const { return dt_critical; }

    Unknowns      static_springs(const Structure &structure) const override;
    ContactResult solve_static(const DamSolve &solve, const Unknowns &springs, const Unknowns &u,
                               Unknowns &load, Log &log) override;

    /** Throws InputError in these cases:
     *  - the time step of the rock exceeds the critical one,
     *  - the artificial boundary would be unstable (ArtificialBoundary::check()) or is too close to the
     *    base. */
    void check(const TimeGrid &grid, unsigned int steps_per_sample) const override;

    void    start(const GroundMotion &outcrop, const TimeGrid &grid, const Unknowns &u) override;
    void    advance(Unknowns &load) override;
    void    update_from_dam(const DynamicState &state) override;
    Vector3 base_velocity() const override;
    double  seconds() const override { return seconds_advancing; }
    double  work() const override { return work_advancing; }

    std::vector<std::pair<std::string, double>> energies() const override;
    double                                      balance_error() const override;
    void                                        report_balance(Log &log) const override;
    std::vector<std::vector<double> *>          state() override;
    void                                        gather_on_root() override { region->gather_on_root(); }

    NeighbourMonitor *monitor() override { return rock_monitor.get(); }

    /** Returns the energies of the rock and of its coupling with the dam. Must be called after start(). */
    const RockBalance &energy_balance() const { return *balance; }

  protected:
    /** Creates the region at rest and its incident waves.
     *
     * @param outcrop ground motion at a free surface
     * @param steps time steps
     * @param delay delay of the incident waves [s]
     * @param near_base nodes near the base that rank @p ahead steps for its prediction. All ranks step the
     * base nodes. */
    void make_rock(const GroundMotion &outcrop, const TimeGrid &steps, double delay,
                   const std::vector<unsigned int> &near_base = {});

    /** Gathers the energies of the ranks, prepares monitor() and updates energy_balance(). Must be called by
     * all ranks at the end of a time step. @p time: time of the dam [s]. */
    void finish_step(double time);

    const FoundationParameters      parameters;
    HexMesh                         mesh;
    const std::string               source;
    const bool                      incompatible_modes; ///< of the dam's elements
    std::array<double, 3>           centre{}; ///< of the dam base, assumed source of scattered waves [m]
    RockModel                       model;
    std::vector<BaseNode>           at_base;      ///< base nodes
    std::unique_ptr<ExplicitRegion> region;       ///< after start()
    std::unique_ptr<RockBalance>    balance;      ///< after start()
    std::unique_ptr<RockMonitor>    rock_monitor; ///< after start()
    std::unique_ptr<RockStaticState>
                 static_state; ///< from add_stiffness() to start(), which frees its memory
    unsigned int ahead = 0;    ///< rank that owns most nodes near the base
    TimeGrid     grid;
    double       dt_critical = 0.;         ///< of the rock [s]
    double       seconds_advancing = 0.;   ///< wall time [s]
    double       work_advancing = 0.;      ///< CPU time, without messages [s]
    Unknowns     rest;                     ///< static displacement of the base nodes [m]
    Unknowns     u_base_nodes, v, a;       ///< motion of the base nodes
    Unknowns     force, force_before;      ///< of the rock elements on the base nodes [N]
    Unknowns     u_predicted, v_predicted; ///< of the base nodes at the end of the step
  };
} // namespace Voussoir

#endif
