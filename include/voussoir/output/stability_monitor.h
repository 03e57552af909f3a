// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_stability_monitor_h
#define voussoir_stability_monitor_h

#include <voussoir/base/excess.h>
#include <voussoir/dam/dam.h>
#include <voussoir/motion/ground_motion.h>
#include <voussoir/output/observer.h>
#include <voussoir/output/recorders.h>
#include <voussoir/output/run_state.h>

namespace Voussoir
{
  /** Bounds of a ground motion and of the response of linear structures to the motion. */
  struct MotionBounds
  {
    double velocity = 0.;     ///< peak ground velocity (PGV) [m/s]
    double displacement = 0.; ///< peak ground displacement (PGD) [m]
    /** Upper bound of the velocity of an oscillator of any frequency on this ground [m/s]. The bound of
     * Duhamel's integral with the damping alpha M is the maximum over t of the integral of
     * |a(s)| exp(-alpha (t - s)/2) ds. */
    double oscillator = 0.;
  };

  /** Returns the bounds of a ground motion. Velocity and displacement are integrals of the piecewise linear
   * acceleration, from rest. @p mass_damping: factor alpha of the mass matrix in the damping matrix [1/s]. */
  MotionBounds bounds_of(const GroundMotion &motion, double mass_damping);

  /** Monitor of instability. It compares the nodes of dam and rock, and the energy that enters the rock, with
   * bounds that an earthquake cannot exceed. The bounds scale with the motion and with the static state:
   *
   * - velocity of the dam: 10 times (MotionBounds::oscillator + v0). The oscillator's velocity bounds the
   *   mean over the mass of a structure that only loses energy. The factor 10 allows for faster nodes. The
   *   velocity v0 = sqrt(2 E0/M) has the energy E0 at the start as kinetic energy of the dam's mass M. Forces with a
   *   history add to it;
   * - velocity of the rock: 10 times (PGV + v0). Soil layers and valleys amplify the outcrop motion by less;
   * - displacement from the static state: 10 PGD, and the displacement of an oscillator with a period of 1 s
   *   at the bound of the velocity;
   * - energy that enters through the artificial boundary: 3 times the energy of the incident wave and E0. The
   *   incident energy is the integral of rho c v^2 at the bottom, with half the outcrop velocity. A fixed
   *   boundary has no such bound, since resonance in the rock box is stable;
   * - energy that the coupling of dam and rock generates: the same bound. */
  class StabilityMonitor
  {
  public:
    /** Computes the bounds at the start of the time loop, and sets those of Neighbour::monitor().
     * @param dam dam; must outlive the object
     * @param motion ground motion of the run
     * @param integrator time integration in the static state */
    StabilityMonitor(const Dam &dam, const GroundMotion &motion, const Integrator &integrator);

    /** Returns a message about an instability with suggestions, or an empty text. Energies and joints are
     * checked in each step, the nodes in each NeighbourMonitor::interval-th step and in
     * the last step.
     * @param integrator present state
     * @param step number of steps done
     * @param last true: it is the last step of the run */
    std::string instability(const Integrator &integrator, unsigned int step, bool last) const;

  private:
    std::string of_joints(const Integrator &integrator) const;
    std::string of_dam(const DynamicState &state) const;
    std::string suggestions() const;

    const Dam     &dam;
    const Unknowns u_static;
    double         velocity_dam, displacement_dam; ///< bounds [m/s], [m]

    std::vector<NeighbourMonitor *> of_neighbours; ///< monitors of the neighbours of the dam
  };

  /** Observer for instability: record() throws ComputationError if the run has become unstable. */
  class StabilityObserver : public Observer
  {
  public:
    /** Computes the bounds. @p run: state at the start of the time loop; must outlive the observer. */
    explicit StabilityObserver(const RunState &run) : run(run), monitor(*run.dam, run.motion, *run.integrator)
    {
    }
    void record() override;

  private:
    const RunState        &run;
    const StabilityMonitor monitor;
  };
} // namespace Voussoir

#endif
