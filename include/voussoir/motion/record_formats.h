// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_record_formats_h
#define voussoir_record_formats_h

#include <voussoir/motion/record_text.h>

#include <array>

namespace Voussoir
{
  /** Component of an accelerogram. */
  struct MotionChannel
  {
    std::string name;         ///< as in the file, or empty
    char        axis = '?';   ///< x, y: of the dam; z: vertical; h: horizontal with azimuth; ?: unknown
    double      azimuth = 0.; ///< of axis h, clockwise from north [degrees]
    double      sign = 1.;    ///< -1: positive downwards

    std::vector<double>   values;                 ///< in the unit of the file
    std::array<double, 3> parts = {{0., 0., 0.}}; ///< factors for x, y, z of the motion [-], of read_motion()

    /** Sets name and direction from text such as NS, E-W, up, HNZ, 230 or "90 Deg". */
    void set_direction(const std::string &text);
  };

  /** Accelerogram with the values and the unit of its file. */
  struct MotionRecord
  {
    double                     start = 0.; ///< time of the first sample [s]; 0 except in tables
    double                     dt = 0.;    ///< sampling interval [s]
    std::vector<MotionChannel> channels;   ///< of equal length
    std::string                unit;       ///< unit_name() that the file states, or empty
    std::string                clock;      ///< date and time of the first sample to the second, or empty

    bool        is_table = true; ///< false: the format has its own unit; "Motion/Unit" is then ignored
    std::string notes;           ///< format and corrections, for the log

    /** Returns the time from the first to the last sample [s]. */
    double duration() const;
  };

  /** Format of the records of an agency. */
  struct RecordFormat
  {
    const char *name, *source; ///< source: public description
    bool (*is)(const RecordText &);
    MotionRecord (*read)(const RecordText &); ///< throws InputError
  };

  /** Returns the format of a file by its content, or nullptr. */
  const RecordFormat *record_format_of(const RecordText &text);

  /** Returns the names of all formats, separated by commas. */
  std::string record_format_names();
} // namespace Voussoir

#endif
