// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_motion_record_h
#define voussoir_motion_record_h

#include <voussoir/motion/record_formats.h>

namespace Voussoir
{
  /** Reads a table or a file of an agency (record_format_of()). Its content determines the format.
   *
   * A table has one line per time, with t [s] and @p n_channels accelerations. Blanks, tabs, commas or semicolons
   * separate the numbers. The time steps are equal. The text after # is a comment. The first line may have
   * headings without numbers. They state quantity, unit and direction of the columns, in any sequence. Without
   * headings the columns are t, a_x, a_y, a_z.
   *
   * @param file path
   * @param n_channels 1, 3, or 0: any number
   * @param step sampling interval of a table without times, "Motion/File step" [s]; 0: none
   *
   * Throws InputError with file and line in these cases:
   *  - The file is not a regular text file of at most 100 MB, or a line exceeds a million characters.
   *  - The number of columns or values is wrong, or a value is not a finite number.
   *  - The time does not increase, or the time steps differ from each other or from @p step.
   *  - A column or the record is not an acceleration, or has decimal commas. */
  MotionRecord read_motion_record(const std::string &file, unsigned int n_channels, double step = 0.);

  /** Heading of a column such as "a_x [cm/s2]", "Acc. N-S (g)", EW or "Period (s)". */
  struct Heading
  {
    std::string   text;
    std::string   unit; ///< unit_name(), or an unknown unit with its parentheses, as in "(mg)", or empty
    char          quantity = '?'; ///< t, a, v (velocity), d (displacement), f (frequency), or ? (unknown)
    MotionChannel channel;        ///< name and direction
  };

  /** Numbers of a text file with equal separators, comments and headings as the tables of
   * read_motion_record(). */
  struct NumberTable
  {
    std::vector<Heading>             headings; ///< of the first line, or empty
    std::vector<std::vector<double>> rows;     ///< at least one number each
    std::vector<std::size_t>         lines;    ///< number of the line of each row
    std::string                      unit;     ///< unit_name() in the headings, or empty
  };

  /** Reads a table with any number of columns. Throws InputError with file and line if a value is not a finite
   * number. */
  NumberTable read_number_table(const RecordText &text);
} // namespace Voussoir

#endif
