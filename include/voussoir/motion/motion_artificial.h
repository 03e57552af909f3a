// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_motion_artificial_h
#define voussoir_motion_artificial_h

#include <voussoir/motion/ground_motion.h>
#include <voussoir/motion/motion_parameters.h>
#include <voussoir/motion/spectral_matching.h>

namespace Voussoir
{
  /** Returns the target of a component without "Factor" and "Scale": 100 periods per decade in the range to
   * match, and some longer periods, which limit the displacement. */
  SpectralTarget make_target(const MotionParameters &parameters, unsigned int direction);

  /** Returns one component of an artificial motion without "Factor" and "Scale" [m/s^2], with
   * parameters.n_steps() + 1 samples.
   *
   * The start is a trigonometric series with random phases, multiplied by the MotionEnvelope and, in the last
   * twentieth, by a cosine that ends at zero. Its power spectrum corresponds to the design spectrum (Kaul
   * 1978). The series is corrected in the frequency domain, and then in the time domain with
   * match_spectrum(). The largest absolute acceleration equals the peak acceleration of the target. Velocity
   * and displacement end at zero.
   *
   * @param parameters section "Motion"
   * @param direction 0, 1 or 2 for x, y or z
   * @param attempt number that selects the random phases, with the seed and the direction. Equal numbers give
   * the same motion. */
  std::vector<double> make_artificial_component(const MotionParameters &parameters, unsigned int direction,
                                                unsigned int attempt);

  /** Returns an artificial motion with three components, without "Factor" and "Scale". A component that does
   * not satisfy MotionCriteria is generated again, with at most six attempts in all. The best attempt is
   * used. motion_warnings() reports criteria that are still not satisfied. */
  GroundMotion make_artificial_motion(const MotionParameters &parameters);
} // namespace Voussoir

#endif
