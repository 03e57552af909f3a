// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_curve_file_h
#define voussoir_curve_file_h

#include <fstream>
#include <string>
#include <vector>

namespace Voussoir
{
  /** Opens a text file after its byte order mark of UTF-8. Throws InputError with @p message if it cannot be read, or
   * if it is a directory, a pipe or a device, because reading from those may block. */
  std::ifstream open_text(const std::string &file, const std::string &message);

  /** Curve of a file: values y at ascending x. */
  struct Curve
  {
    std::vector<double> x, y;

    /** Returns y at @p at: linear between the rows, constant before the first and after the last. */
    double at(double at) const;
  };

  /** Words for the messages of read_curve(), such as "The spectrum ", "period", "periods", "[s]", "acceleration
   * [m/s^2]", and what to do if the file cannot be read. */
  struct CurveWords
  {
    const char *curve, *x, *all_x, *unit, *y, *without_file;
  };

  /** Reads a table with two columns of numbers that are at least zero; the first column ascends. Blanks, tabs,
   * commas or semicolons separate the numbers. The text after # is a comment. The first line may have headings.
   * Throws InputError with file and line if a line is wrong, and if the table has fewer than two rows. */
  Curve read_curve(const std::string &file, const CurveWords &words);
} // namespace Voussoir

#endif
