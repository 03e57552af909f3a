// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_motion_files_h
#define voussoir_motion_files_h

#include <voussoir/motion/ground_motion.h>
#include <voussoir/motion/motion_parameters.h>

namespace Voussoir
{
  /** The motion of the files that section "Motion" names, in m/s^2, times "Factor", before "Scale".
   *
   *  Each record is brought to the analysis' time step on its own (resample()). The motion lasts for
   *  "Duration", or, where that is automatic, as many whole time steps as the shortest record has.
   * InputError: a record that cannot be read, that ends before a given "Duration", or that starts at another
   * time than the component before it. */
  GroundMotion read_motion(const MotionParameters &parameters, const std::string &scene_directory);

  /** For a scene that does not say the unit of its tables: a warning if all their numbers are below 1 m/s^2
   * and no heading states a unit, since they may be in g; else empty. */
  std::string unit_warning(const MotionParameters &parameters, const std::string &scene_directory);
} // namespace Voussoir

#endif
