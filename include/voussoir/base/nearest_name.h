// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_nearest_name_h
#define voussoir_nearest_name_h

#include <string>
#include <vector>

namespace Voussoir
{
  /** Number of letters to change, add or remove to make @p a from @p b; case does not count. */
  unsigned int edit_distance(const std::string &a, const std::string &b);

  /** The one of @p names with the smallest edit_distance(), the first of equals. */
  std::string nearest_name(const std::vector<std::string> &names, const std::string &name);
} // namespace Voussoir

#endif
