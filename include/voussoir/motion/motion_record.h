// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_motion_record_h
#define voussoir_motion_record_h

#include <string>
#include <vector>

namespace Voussoir
{
  /** Accelerogram with the values and the unit of its file. */
  struct MotionRecord
  {
    double                           start = 0.;   ///< time of the first sample [s]; 0 for AT2
    double                           dt = 0.;      ///< sampling interval [s]
    std::vector<std::vector<double>> components;   ///< samples, of equal length, in the unit of the file
    bool                             in_g = false; ///< true for AT2 files; "Motion/Unit" is then ignored
    std::string                      unit;         ///< unit_name() in the headings of a table, or empty

    /** Returns the time from the first to the last sample [s]. */
    double duration() const;
  };

  /** Reads a table or a PEER AT2 file. The content of the file determines its format.
   *
   * A table has one line per time, with t [s] and @p n_components (1 or 3) accelerations. Blanks, tabs,
   * commas or semicolons separate the numbers. The time steps are equal. The text after # is a comment. The
   * first line may have headings without numbers. Lines end in LF, CR LF or CR.
   *
   * An AT2 file has one component. Its header states NPTS and DT in any of the three forms of PEER. The NPTS
   * values follow, in any number of columns.
   *
   * Throws InputError with file and line in these cases:
   *  - The file is not a regular text file of at most 100 MB, or a line exceeds a million characters.
   *  - The number of columns is wrong, or a value is not a finite number.
   *  - The time does not increase, or the time steps differ.
   *  - An AT2 file is not an acceleration in g, or its number of values is not NPTS. */
  MotionRecord read_motion_record(const std::string &file, unsigned int n_components);

  /** Numbers of a text file with equal separators, comments and headings as the tables of
   * read_motion_record(). */
  struct NumberTable
  {
    std::vector<std::vector<double>> rows;  ///< at least one number each
    std::vector<std::size_t>         lines; ///< number of the line of each row
    std::string                      unit;  ///< unit_name() in the headings, or empty
  };

  /** Reads a table with any number of columns. Throws InputError with file and line if the file is not a
   * regular text file of at most 100 MB, or a value is not a finite number. */
  NumberTable read_number_table(const std::string &file);
} // namespace Voussoir

#endif
