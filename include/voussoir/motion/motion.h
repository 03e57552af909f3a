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

  /** Writes a table with one row for each motion of an ensemble, with its first factor: TargetFit, the measures of
   * MotionReport, and rotated_response() at 0.2 s and 1 s, in SI units. Throws InputError as make_motion(), and
   * WriteError. @param file path of suite.csv */
  void write_suite(const std::vector<EnsembleMember> &members, const std::string &scene_directory,
                   const std::string &file);
} // namespace Voussoir

#endif
