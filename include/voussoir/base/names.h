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
  /** Values of an enumeration with their names in input and output files. */
  template <typename T> using Names = std::vector<std::pair<const char *, T>>;

  /** Names of entries, "Section/Entry". A name with a slash at the end means all entries of a section. */
  using EntryNames = std::vector<std::string>;

  /** Returns whether @p names include the entry. */
  inline bool includes(const EntryNames &names, const std::string &entry)
  {
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string &name)
                       { return name.back() == '/' ? entry.rfind(name, 0) == 0 : entry == name; });
  }

  // Tables have rows {name, doc, ...}. All lists keep the order of the rows.

  /** Returns the names in a table as a ParameterHandler selection, such as "rigid|rock|massless". */
  template <class Rows> std::string names_of(const Rows &rows, const std::string &separator = "|")
  {
    std::string list;
    for (const auto &row : rows)
      list += (list.empty() ? "" : separator) + row.name;
    return list;
  }

  /** Returns names and descriptions of a table, such as "rigid: the base moves as the ground
   * motion; rock: ...". */
  template <class Rows> std::string docs_of(const Rows &rows)
  {
    std::string list;
    for (const auto &row : rows)
      list += (list.empty() ? "" : "; ") + std::string(row.name) + ": " + row.doc;
    return list;
  }

  /** Returns the row with the given @p name. For an unknown name it throws InputError with the text "There
   * @p is_no "name". @p they_are rigid|rock|massless." */
  template <class Row, std::size_t n>
  const Row &row_of(const Row (&rows)[n], const std::string &name, const std::string &is_no,
                    const std::string &they_are)
  {
    for (const Row &row : rows)
      if (name == row.name)
        return row;
    throw InputError("There " + is_no + " \"" + name + "\". " + they_are + " " + names_of(rows) + ".");
  }

  /** Returns all names as a ParameterHandler selection, such as "newton|sweeps|...". */
  template <typename T> std::string selection(const Names<T> &names)
  {
    std::string list;
    for (const auto &entry : names)
      list += (list.empty() ? "" : "|") + std::string(entry.first);
    return list;
  }

  /** Returns the value with the given @p name. For an unknown name it throws InputError with the text "There
   * @p is_no "name". The @p kind are: ..." */
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
