// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_arc_table_file_h
#define voussoir_arc_table_file_h

#include <string>
#include <vector>

namespace Voussoir
{
  /** Table of arcs: numbers by column. */
  struct ArcTable
  {
    std::string              file;
    std::vector<std::string> columns; ///< the first: elevation
    std::vector<std::vector<double>>
        rows; ///< in the order of the elevation [m, degrees]; face: 0 upstream, 1 downstream
  };

  /** Reads a table (CSV) with the given columns; further columns are ignored.
   *
   * Throws InputError, with file, line and column, for a file that cannot be read, a missing or repeated column, a
   * line with another number of values, and a value that no dam has: not a number, beyond 1e5, a radius or thickness
   * that is not positive, an angle of 85 degrees or more, angles that are all below 2 degrees (radians). */
  ArcTable read_arc_table(const std::string &file, const std::vector<std::string> &columns);
} // namespace Voussoir

#endif
