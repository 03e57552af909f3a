// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_names_h
#define voussoir_names_h

#include <voussoir/base/error.h>

#include <string>
#include <utility>
#include <vector>

namespace Voussoir
{
  /** The values of an enumeration and the names that scenes and results give them. */
  template <typename T> using Names = std::vector<std::pair<const char *, T>>;

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
