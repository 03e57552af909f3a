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
  /** Elastic rock with mass and explicit time integration (ExplicitRegion). Displacements of the rock are
   * those of the earthquake only; the static displacements are superposed. The derived classes couple the
   * rock with the dam in time: PartitionedRock and SubcycledRock. */
  class ExplicitRock : public Foundation
  {
  public:
    /** Copies the parameters and the mesh of @p site. Throws InputError if the element degree is not 1. */
    explicit ExplicitRock(const FoundationSite &site);

    Base base() const override = 0;
    bool uses_rock() const override { return true; }
    bool moves_base() const override { return false; }

    /** Returns true, because the free field is computed for the length of the ground motion. */
    bool resumes_longer_only() const override { return true; }

    /** Finds the base nodes, assembles the rock and computes the critical time step. The stiffness of the
     * @p structure is unchanged. Throws InputError if the artificial boundary cannot use the mesh. */
    void add_stiffness(const SolidModel &dam, Structure &structure) override;

    /** Writes materials, size, boundary and arrival time of the rock to the log, with warnings. */
    void report(Log &log, const TimeGrid &grid) const override;

    /** Adds the object "rock" with size, boundary, time steps and, after start(), energies. */
    void add_to_summary(Json &summary, const TimeGrid &grid) const override;

    /** Returns the time at which the ground motion arrives at the lowest base node: the travel time of the S
     * waves [s]. All components arrive at this time, because the faster P wave enters the rock
     * later by arrives[0] - arrives[2]. */
    double delay() const override { return arrives[0]; }

    /** Returns the critical time step of the rock, with its damping [s]; 0 before add_stiffness(). */
    double critical_time_step() const { return dt_critical; }

    /** Returns the smaller one of the limits of rock and boundary [s]. */
    double largest_step() const override { return std::min(dt_critical, dt_boundary); }

    /** Returns the free field of the section upstream, or of the highest column. It has its own
     * integration, ahead of the rock. */
    std::unique_ptr<ValleyMotion> valley(const std::vector<Vector3> &places) override;

    // Static state by RockStaticState. Must be called after add_stiffness() and before start().
    Unknowns      static_springs(const Structure &structure) const override;
    ContactResult solve_static(const DamSolve &solve, const Unknowns &springs, const Unknowns &u,
                               Unknowns &load, std::string &failure, Log &log) override;

    /** Throws InputError if the time step of the rock exceeds the critical one, or if the artificial boundary would be
     * unstable (ArtificialBoundary::check()) or is too close to the base. */
    void check(const TimeGrid &grid, unsigned int steps_per_sample) const override;

    double seconds() const override { return seconds_advancing; }
    double work() const override { return work_advancing; }

    // Energies by RockBalance: zero or empty before start(). report_balance() then writes nothing.
    std::vector<std::pair<std::string, double>> energies() const override;
    double                                      balance_error() const override;
    void                                        report_balance(Log &log) const override;

    /** Gathers the state of the rock on the first rank. Must be called after start(). */
    void gather_on_root() override
    {
      if (region) // null until start(), which a static analysis does not call
        region->gather_on_root();
    }

    NeighbourMonitor *monitor() override { return rock_monitor.get(); }

    /** Returns the energies of the rock and of its coupling with the dam. Must be called after start(). */
    const RockBalance &energy_balance() const { return *balance; }

  protected:
    /** Creates the region at rest with its incident waves, its balance and its monitor. Frees the memory of
     * the static state and of the stiffness matrix of the model.
     *
     * @param outcrop ground motion at a free surface; the upward wave has half of its displacement
     * @param steps time steps
     * @param delay shift of the incident waves relative to ExplicitRegion::time() [s]. PartitionedRock: 0.
     * SubcycledRock: half a rock time step, because its rock displacements belong to a time that is earlier
     * by this shift. Independent of delay(), which is a travel time.
     * @param near_base rock nodes that SubcycledRock::predict() requires; empty: none. They are computed by
     * predicting_rank, the base nodes by all ranks. */
    void make_rock(const GroundMotion &outcrop, const TimeGrid &steps, double delay,
                   const std::vector<unsigned int> &near_base);

    /** Gathers the energies of the ranks, prepares monitor() and updates energy_balance(). Must be called by
     * all ranks at the end of a time step. @p time: time of the dam [s]. */
    void finish_step(double time);

    const FoundationParameters parameters;         ///< of the input file
    HexMesh                    mesh;               ///< of dam and rock; empty after add_stiffness()
    const std::string          source;             ///< name of the mesh in messages
    const std::string          generated_in;       ///< FoundationSite::generated_in
    const bool                 incompatible_modes; ///< of the dam's elements

    // From add_stiffness() on.
    std::array<double, 3> centre{}; ///< mean position of the base, source of scattered waves [m]
    RockModel             model;    ///< after start() without stiffness matrix
    std::vector<BaseNode> at_base;  ///< base nodes, ascending by rock node
    /** Travel times of the upward waves to the lowest base node: S waves with motion in x and y, P wave with motion in
     * z [s]. The waves enter one element below the lowest rock node. */
    Vector3 arrives{};
    double  dt_critical = 0.; ///< critical time step of the rock [s]
    double  dt_boundary = 0.; ///< largest_boundary_step() [s]

    std::unique_ptr<RockStaticState> static_state; ///< from add_stiffness() to start()

    // From start() on.
    TimeGrid                        grid;                 ///< time steps of the run
    std::unique_ptr<ExplicitRegion> region;               ///< time integration of the rock
    IncidentWave                    rising;               ///< incident wave
    double                          delay_of_region = 0.; ///< argument delay of make_rock() [s]
    std::unique_ptr<RockBalance>    balance;      ///< energies of the rock and of its coupling with the dam
    std::unique_ptr<RockMonitor>    rock_monitor; ///< monitor of the instability

    /** Rank that owns most nodes near the base. It computes the nodes near the base of the other ranks, too,
     * so that it can compute SubcycledRock::predict() without messages. */
    unsigned int predicting_rank = 0;

    double seconds_advancing = 0.; ///< wall time of the rock so far [s]
    double work_advancing = 0.;    ///< CPU time of the rock so far on this rank, without messages [s]
  };
} // namespace Voussoir

#endif
