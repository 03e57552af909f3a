// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_motion_record_h
#define voussoir_motion_record_h

#include <string>
#include <vector>

namespace Voussoir
{
  /** A record as its file has it. */
  struct MotionRecord
  {
    double                           start = 0.;   ///< time of the first sample [s]; 0 in AT2
    double                           dt = 0.;      ///< sampling interval [s]
    std::vector<std::vector<double>> components;   ///< of equal length, in the file's unit
    bool                             in_g = false; ///< AT2, whatever unit the scene states
    std::string                      unit; ///< that a table's headings state, as Motion/Unit; or empty

    double duration() const; ///< from the first to the last sample [s]
  };

  /** Read a table or a PEER AT2 file, told apart by their content.
   *
   *  A table has a line for each time: t [s] and n_components (1 or 3) accelerations, separated by blanks
   *  or commas, at equal steps; the rest of a line after # is a comment, and one line of headings, without
   *  numbers, may come first. Lines end in LF, CR LF or CR. AT2 (one component) has a header with NPTS and DT
   * in any of PEER's three forms, then that many values in any number of columns.
   *
   *  InputError, with file and line: anything but a regular file of text of at most 100 MB, a line of more
   * than a million characters, a wrong number of columns, anything but a finite number, time that does not
   * increase or steps that differ, a number of values other than NPTS, an AT2 file of velocity or
   * displacement. */
  MotionRecord read_motion_record(const std::string &file, unsigned int n_components);
} // namespace Voussoir

#endif
