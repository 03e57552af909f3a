// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_names_h
#define voussoir_names_h

#include <voussoir/base/error.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace Voussoir
{
  /** The values of an enumeration and the names that scenes and results give them. */
  template <typename T> using Names = std::vector<std::pair<const char *, T>>;

  /** Entries by their names, "Section/Entry"; a name that ends in a slash stands for all below it. */
  using EntryNames = std::vector<std::string>;

  /** Do the names include the entry? */
  inline bool includes(const EntryNames &names, const std::string &entry)
  {
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string &name)
                       { return name.back() == '/' ? entry.rfind(name, 0) == 0 : entry == name; });
  }

  // Tables have rows {name, doc, ...}, whose order is that of all lists.

  /** The names in a table: "rigid|rock|massless", as a ParameterHandler selection. */
  template <class Rows> std::string names_of(const Rows &rows, const std::string &separator = "|")
  {
    std::string list;
    for (const auto &row : rows)
      list += (list.empty() ? "" : separator) + row.name;
    return list;
  }

  /** What the rows of a table are: "rigid: the base moves as the ground motion says; rock: ...". */
  template <class Rows> std::string docs_of(const Rows &rows)
  {
    std::string list;
    for (const auto &row : rows)
      list += (list.empty() ? "" : "; ") + std::string(row.name) + ": " + row.doc;
    return list;
  }

  /** The row of that name in a table. Throws InputError, "There @p is_no "name". @p they_are ...", for an
   * unknown one. */
  template <class Row, std::size_t n>
  const Row &row_of(const Row (&rows)[n], const std::string &name, const std::string &is_no,
                    const std::string &they_are)
  {
    for (const Row &row : rows)
      if (name == row.name)
        return row;
    throw InputError("There " + is_no + " \"" + name + "\". " + they_are + " " + names_of(rows) + ".");
  }

  /** All names as a ParameterHandler selection: "newton|sweeps|...". */
  template <typename T> std::string selection(const Names<T> &names)
  {
    std::string list;
    for (const auto &entry : names)
      list += (list.empty() ? "" : "|") + std::string(entry.first);
    return list;
  }

  /** The value of that name. Throws InputError, "There @p is_no "name". The @p kind are: ...", for an unknown
   *  one. */
  template <typename T>
  T value_of(const Names<T> &names, const std::string &name, const std::string &is_no,
             const std::string &kind)
  {
    for (const auto &entry : names)
      if (name == entry.first)
        return entry.second;
    throw InputError("There " + is_no + " \"" + name + "\". The " + kind + " are: " + selection(names) + ".");
  }
} // namespace Voussoir

#endif
