// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_motion_h
#define voussoir_motion_h

#include <voussoir/motion/ground_motion.h>
#include <voussoir/motion/motion_parameters.h>

namespace Voussoir
{
  /** Returns the ground motion of an input file, by its entry "Motion/Source":
   *  - file: read_motion(). A component without a file is zero.
   *  - artificial: make_artificial_motion().
   *  - none: zero acceleration.
   *
   * All components are multiplied by "Factor", and each component by its "Scale x", "Scale y" or "Scale z".
   *
   * @param parameters section "Motion"
   * @param scene_directory directory of the input file
   *
   * Throws InputError if a record or an entry is wrong, and if a sample is not finite or exceeds 1000 g. */
  GroundMotion make_motion(const MotionParameters &parameters, const std::string &scene_directory);
} // namespace Voussoir

#endif
