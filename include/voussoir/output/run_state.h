// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_run_state_h
#define voussoir_run_state_h

#include <voussoir/dam/static_state.h>
#include <voussoir/dynamics/newmark.h>
#include <voussoir/motion/ground_motion.h>

namespace Voussoir
{
  /** A run between two steps: the dam, the ground motion and the state of the time integration. The time loop
   *  changes it, observers read it. */
  struct RunState
  {
    std::unique_ptr<Dam>     dam;
    GroundMotion             motion;
    StaticState              statics;
    std::unique_ptr<Newmark> newmark;

    unsigned int           n_steps = 0;    ///< of the whole run; 0: static state only
    unsigned int           step = 0;       ///< number of steps done
    unsigned int           start_step = 0; ///< the value of step at the start of this process
    std::vector<PairState> pairs_at_start; ///< at start_step

    Unknowns u_before;               ///< displacement before the last step, 3 per node [m]
    Vector3  base_velocity_before{}; ///< DynamicState::base_velocity before the last step [m/s]
    Unknowns acceleration;           ///< mean over the last step, that of the base included [m/s^2]

    const Scene &scene() const { return dam->scene; }
    TimeGrid     grid() const { return {motion.dt, scene().foundation.substeps, n_steps}; }
    bool         is_last() const { return step == n_steps; }

    /** Does a record with this interval of steps include the present step? Interval 0: never. */
    bool is_due(const unsigned int interval) const { return interval > 0 && step % interval == 0; }

    /** Contact states of the pairs after the last step. */
    const std::vector<PairState> &pairs() const
    {
      return step == start_step ? pairs_at_start : newmark->pair_states();
    }

    /** Makes foundation and time integration ready for the first step from the static state. @p parameters:
     * of the contact solver. */
    void start(const ContactParameters &parameters);

    /** Loads at the end of the next step, without those of the foundation, 3 per node [N]. */
    Unknowns next_load() const;

    /** Acceleration of the base after so many steps, if displacements count from the base; else 0 [m/s^2]. */
    Vector3 ground_acceleration(unsigned int after) const;

    /** Displacement of a node of the mesh relative to the base (on rock: to its lowest part), the static one
     *  included [m]. */
    Vector3 relative_to_base(unsigned int node) const;

    /** Largest energy of the run, the reference of energy balances [J]. */
    double largest_energy() const;
  };
} // namespace Voussoir

#endif
