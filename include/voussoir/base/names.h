// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_names_h
#define voussoir_names_h

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace Voussoir
{
  /** Returns a list of the texts that are not empty. @p text: function that returns the text of an item. */
  template <class Items, class Text>
  std::string listed(const Items &items, const Text &text, const std::string &separator = ", ")
  {
    std::string list;
    for (const auto &item : items)
      if (const std::string one = text(item); !one.empty())
        list += (list.empty() ? "" : separator) + one;
    return list;
  }

  /** Names of the values of an enumeration in input and output files: {name, value}. T: the enumeration. */
  template <typename T> using Names = std::vector<std::pair<const char *, T>>;

  /** Names of entries of the input file, "Section/Entry". A name with a slash at the end, "Section/", means all
   * entries of a section. */
  using EntryNames = std::vector<std::string>;

  /** Returns true if @p names contain the @p entry or its section. */
  inline bool includes(const EntryNames &names, const std::string &entry)
  {
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string &name)
                       { return name.back() == '/' ? entry.rfind(name, 0) == 0 : entry == name; });
  }

  /** Returns true if @p names contain all @p parts or their sections. */
  inline bool includes_all(const EntryNames &names, const EntryNames &parts)
  {
    return std::all_of(parts.begin(), parts.end(),
                       [&](const std::string &part)
                       { return includes(names, part) || std::count(names.begin(), names.end(), part) > 0; });
  }

  /** Throws InputError with a message. */
  [[noreturn]] void refuse_name(const std::string &message);

  // Below, the rows of a table are structs with the members name and doc (a short description).

  /** Returns the names of a table in the order of the rows, such as "rigid|rock|massless", a selection of
   * dealii::ParameterHandler. */
  template <class Rows> std::string names_of(const Rows &rows, const std::string &separator = "|")
  {
    return listed(
        rows, [](const auto &row) { return std::string(row.name); }, separator);
  }

  /** Returns names and descriptions of a table for a help text, such as "rigid: prescribed ground motion at
   * the base of the dam; rock: ...". */
  template <class Rows> std::string docs_of(const Rows &rows)
  {
    return listed(
        rows, [](const auto &row) { return std::string(row.name) + ": " + row.doc; }, "; ");
  }

  /** Returns the row with the given @p name from a table. For an unknown name it throws InputError with the
   * text: There @p is_no "name". @p they_are rigid|rock|massless. Examples: @p is_no "is no foundation",
   * @p they_are "The foundations are:". */
  template <class Row, std::size_t n>
  const Row &row_of(const Row (&rows)[n], const std::string &name, const std::string &is_no,
                    const std::string &they_are)
  {
    for (const Row &row : rows)
      if (name == row.name)
        return row;
    refuse_name("There " + is_no + " \"" + name + "\". " + they_are + " " + names_of(rows) + ".");
  }

  /** Returns the names of all values as a selection of dealii::ParameterHandler, such as "mean-force|none". */
  template <typename T> std::string selection(const Names<T> &names)
  {
    return listed(
        names, [](const auto &entry) { return std::string(entry.first); }, "|");
  }

  /** Returns the value with a given name.
   * @param names names and values
   * @param name name to find
   * @param is_no part of the message for an unknown name, such as "is no impact rule"
   * @param kind plural noun for the values in the same message, such as "rules"
   *
   * Throws InputError for an unknown name: There IS_NO "NAME". The KIND are: mean-force|none. */
  template <typename T>
  T value_of(const Names<T> &names, const std::string &name, const std::string &is_no,
             const std::string &kind)
  {
    for (const auto &entry : names)
      if (name == entry.first)
        return entry.second;
    refuse_name("There " + is_no + " \"" + name + "\". The " + kind + " are: " + selection(names) + ".");
  }
} // namespace Voussoir

#endif
