// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_motion_files_h
#define voussoir_motion_files_h

#include <voussoir/motion/ground_motion.h>
#include <voussoir/motion/motion_parameters.h>

namespace Voussoir
{
  /** Reads the ground motion from the files in section "Motion" [m/s^2], with "Factor" and without "Scale".
   *
   * Each record is resampled separately to the time step of the analysis with resample(). The length of the
   * motion is "Duration". If that is automatic, it is the length of the shortest record, in whole time steps.
   *
   * @param parameters section "Motion"
   * @param scene_directory directory of the input file
   * @param begin time of the first sample of the motion after that of the records [s]
   *
   * Throws InputError if a record cannot be read, ends before a given "Duration", has headings with another
   * unit than "Unit", or starts at another time than the first one. */
  GroundMotion read_motion(const MotionParameters &parameters, const std::string &scene_directory,
                           double begin = 0.);

  /** First time of the records of a motion, and last time of the shortest one [s]. */
  struct RecordTimes
  {
    double first, last;
  };

  /** Returns the times in the files of section "Motion". Throws InputError as read_motion(). */
  RecordTimes record_times(const MotionParameters &parameters, const std::string &scene_directory);

  /** Throws InputError if a name in "Motion/Azimuths" is that of no channel or file, in all parts and stations. */
  void check_azimuths(const MotionParameters &parameters, const std::string &scene_directory);

  /** Returns a warning that the tables or the target spectrum may be in g: all values of the records, or the
   * peak acceleration of the target spectrum, are below 1 m/s^2, and no heading states a unit. Returns an empty string otherwise, or if a file cannot be read. Intended for input files without
   * the entry "Motion/Unit". */
  std::string unit_warning(const MotionParameters &parameters, const std::string &scene_directory);
} // namespace Voussoir

#endif
