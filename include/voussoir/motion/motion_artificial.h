// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_motion_artificial_h
#define voussoir_motion_artificial_h

#include <voussoir/motion/ground_motion.h>
#include <voussoir/motion/motion_parameters.h>

namespace Voussoir
{
  /** One component of an artificial motion [m/s^2], n_steps() + 1 samples, before "Scale".
   *
   *  A trigonometric series with random phases and the power spectrum that belongs to the design spectrum
   *  (Kaul 1978), under an envelope, is corrected in the frequency domain and then in the time domain
   *  (match_spectrum()) to follow the design spectrum. The largest magnitude is the target's peak
   *  acceleration, and velocity and displacement end at zero. The phases depend on the seed, the direction
   * and the attempt alone: equal input gives equal motion. */
  std::vector<double> make_artificial_component(const MotionParameters &parameters, unsigned int direction,
                                                unsigned int attempt);

  /** All three components, with new attempts where one misses MotionCriteria; when the attempts run out,
   *  the best (which report_motion() will then warn of). */
  GroundMotion make_artificial_motion(const MotionParameters &parameters);
} // namespace Voussoir

#endif
