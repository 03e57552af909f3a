// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_stability_watch_h
#define voussoir_stability_watch_h

#include <voussoir/base/excess.h>
#include <voussoir/dam/dam.h>
#include <voussoir/motion/ground_motion.h>
#include <voussoir/output/recorders.h>

namespace Voussoir
{
  /** What a ground motion can do to anything linear that stands on it. */
  struct MotionBounds
  {
    double velocity = 0., displacement = 0.; ///< largest of the ground itself, PGV and PGD [m/s], [m]
    /** No oscillator on this ground gets faster, whatever its frequency [m/s]: the largest of the integral
     * over |a(s)| exp(-alpha (t - s)/2) ds, the bound of Duhamel's integral with the damping alpha M. */
    double oscillator = 0.;
  };

  /** @p mass_damping: alpha [1/s]. Velocity and displacement are the integrals of the piecewise linear
   * acceleration from rest. */
  MotionBounds bounds_of(const GroundMotion &motion, double mass_damping);

  /** Looks at every node of dam and rock, and at the energy that the rock takes in, for what no earthquake
   * can do. The bounds scale with the motion and with the static state:
   *
   * - speed of the dam: 10 times MotionBounds::oscillator, since the energy norm of a structure that only
   *   loses energy is bounded by it for the mean over the mass; 10 is for the nodes that are faster;
   * - speed of the rock: 10 times PGV, since ground and valley raise the motion of the outcrop by less;
   * - each with v0 = sqrt(2 E0/M) added, the speed that the strain energy of the static state could give to
   *   the dam's mass;
   * - displacements from the static state: 10 PGD and what an oscillator of 1 s makes of these speeds;
   * - energy taken in through the artificial boundary: 3 times what the rising wave brings through the
   *   bottom, the integral of rho c v^2 with half the outcrop's velocity, and E0. A fixed boundary is stable
   *   and may take in more by resonance;
   * - energy made by the coupling of dam and rock: as much.
   *
   * Exponential growth passes from sound values to the bounds within tens of steps. */
  class StabilityWatch
  {
  public:
    /** At the start of the shaking. */
    StabilityWatch(const Dam &dam, const GroundMotion &motion, const Newmark &newmark);

    /** Returns what is wrong after step @p step, or an empty text. Energies and joints are examined in each
     * step, the nodes in every 10th and in the @p last. */
    std::string trouble(const Newmark &newmark, unsigned int step, bool last) const;

  private:
    std::string of_joints(const Newmark &newmark) const;
    std::string of_dam(const DynamicState &state) const;
    std::string remedies() const;

    const Dam     &dam;
    const Unknowns u_static;
    double         velocity_dam, displacement_dam; ///< bounds
  };
} // namespace Voussoir

#endif
