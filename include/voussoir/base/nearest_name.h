// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_nearest_name_h
#define voussoir_nearest_name_h

#include <string>
#include <vector>

namespace Voussoir
{
  /** Returns the number of letters to change, add or remove to transform @p b into @p a. Case is ignored. */
  unsigned int edit_distance(const std::string &a, const std::string &b);

  /** Returns the element of @p names with the smallest edit_distance() to @p name, the first of several.
   * Returns an empty string if @p names is empty. */
  std::string nearest_name(const std::vector<std::string> &names, const std::string &name);
} // namespace Voussoir

#endif
