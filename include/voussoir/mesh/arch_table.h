// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_arch_table_h
#define voussoir_arch_table_h

#include <voussoir/mesh/arch_shape.h>

#include <memory>
#include <string>

namespace Voussoir
{
  /** Returns the names of the kinds of arcs, separated by "|": "circular|parabolic|...". */
  std::string arc_kinds();

  /** Returns the description of each kind of arcs, with the columns of its table. */
  std::string arc_kind_docs();

  /** Reads a dam from a table of arcs (CSV): one arc per line, or one point per line for the kind "points".
   *
   * The first line names the columns, see arc_kind_docs(). Lines that begin with # are comments. Between the arcs
   * all columns are monotone cubic functions of the elevation (Fritsch and Carlson, SIAM J. Numer. Anal. 17, 1980;
   * weighted harmonic mean of Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5, 1984).
   *
   * @param file path of the table
   * @param kind one of arc_kinds()
   *
   * Throws InputError if the table cannot be read, a column is missing or a value is not usable. The message has
   * the file, the line and the column. */
  std::unique_ptr<ArchShape> read_arch_table(const std::string &file, const std::string &kind);
} // namespace Voussoir

#endif
