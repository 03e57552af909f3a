// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_run_state_h
#define voussoir_run_state_h

#include <voussoir/dam/base_force.h>
#include <voussoir/dam/crack_water.h>
#include <voussoir/dam/static_state.h>
#include <voussoir/dynamics/integrator.h>
#include <voussoir/motion/ground_motion.h>

#include <functional>

namespace Voussoir
{
  /** State of a run between two steps: dam, ground motion and time integration. The time loop changes the
   *  state; observers only read the state. */
  struct RunState
  {
    std::shared_ptr<Dam>        dam;        ///< the dam with its foundation
    GroundMotion                motion;     ///< ground motion, with the time step of the dam
    StaticState                 statics;    ///< static state before the earthquake
    std::unique_ptr<Integrator> integrator; ///< time integration of the dam; see start()

    unsigned int           n_steps = 0;    ///< number of steps of the whole run; 0: static state only
    unsigned int           step = 0;       ///< number of steps done
    unsigned int           start_step = 0; ///< value of @p step at the start of this process
    std::vector<PairState> pairs_at_start; ///< contact states of the pairs at @p start_step

    Unknowns u_before;               ///< displacement before the last step, three values per node [m]
    Vector3  base_velocity_before{}; ///< DynamicState::base_velocity before the last step [m/s]
    Unknowns acceleration; ///< mean absolute acceleration of the last step, three values per node [m/s^2]

    std::unique_ptr<CrackWater> crack_water; ///< or null: the pressures in joints are constant

    /** Returns the scene of the dam. */
    const Scene &scene() const { return dam->scene; }

    /** Returns the time steps of dam and rock, and the number of steps. */
    TimeGrid grid() const
    {
      return {motion.dt, scene().is_explicit() ? scene().n_explicit : scene().foundation.n_substeps(),
              n_steps};
    }

    /** Returns true if all steps of the run are done. */
    bool is_last() const { return step == n_steps; }

    /** Returns true if the number of steps done is a multiple of @p interval [steps]. Interval 0: never. */
    bool is_due(const unsigned int interval) const { return interval > 0 && step % interval == 0; }

    /** Returns the contact states of the pairs after the last step. */
    const std::vector<PairState> &pairs() const
    {
      return step == start_step ? pairs_at_start : integrator->pair_states();
    }

    /** Returns the number of the step at which the dam has received a part of the motion and the rest after it.
     * On rock the waves arrive later. @p part: index in motion.parts. */
    unsigned int end_of_part(std::size_t part) const;

    /** Initializes neighbours and time integration from the static state. @p parameters: parameters of the
     * contact solver. */
    void start(const ContactParameters &parameters);

    /** Returns the loads at the end of the next step, without those of the neighbours, three values per node
     * [N]. */
    Unknowns next_load() const;

    /** Returns the acceleration of the base after a number of steps [m/s^2]; 0 if displacements are absolute.
     * @p after: number of steps since the start of the motion. */
    Vector3 ground_acceleration(unsigned int after) const;

    /** Returns the displacement of a node of the mesh relative to the base, including the static displacement
     *  [m]. On rock the reference is the lowest part of the base. */
    Vector3 relative_to_base(unsigned int node) const;

    /** Returns the velocity of a node of the mesh relative to the base [m/s]; with the explicit scheme half an explicit
     * step before the present time. */
    Vector3 velocity_relative_to_base(unsigned int node) const;

    /** Returns the absolute acceleration of a node of the mesh, the mean over the last step [m/s^2]; zero
     * before the first step. On rock with mass it is that of the displacements, which are absolute. */
    Vector3 absolute_acceleration(unsigned int node) const;

    /** Calls @p use with the last step of the dam, for the forces on the base. Before the first step this is the
     * static state. */
    void with_last_step(const std::function<void(const StepOfDam &)> &use) const;

    /** Returns the largest energy of the run, the reference of energy balances [J]. */
    double largest_energy() const;
  };
} // namespace Voussoir

#endif
