// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_motion_h
#define voussoir_motion_h

#include <voussoir/motion/ground_motion.h>
#include <voussoir/motion/motion_parameters.h>

namespace Voussoir
{
  /** The motion of a scene.
   *
   *  file: read_motion(); an absent component is zero. artificial: three components by
   *  make_artificial_component(), whose mutual correlations are at most 0.3. none: zeros. All are multiplied
   * by "Factor" and "Scale x", "Scale y", "Scale z". InputError where a record or an entry is not usable, and
   * where a sample is not finite or above 1000 g. */
  GroundMotion make_motion(const MotionParameters &parameters, const std::string &scene_directory);
} // namespace Voussoir

#endif
