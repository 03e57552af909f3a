// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/names.h>
#include <voussoir/base/nearest_name.h>

#include <algorithm>
#include <cctype>
#include <numeric>

namespace Voussoir
{
  unsigned int edit_distance(const std::string &a, const std::string &b)
  {
    const auto lower = [](const char c) { return std::tolower(static_cast<unsigned char>(c)); };
    std::vector<unsigned int> row(b.size() + 1);
    std::iota(row.begin(), row.end(), 0);
    for (std::size_t i = 1; i <= a.size(); ++i)
    {
      unsigned int diagonal = row[0]++;
      for (std::size_t j = 1; j <= b.size(); ++j)
      {
        const unsigned int old = row[j];
        row[j] =
            std::min({row[j] + 1, row[j - 1] + 1, diagonal + (lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1)});
        diagonal = old;
      }
    }
    return row.back();
  }

  std::string nearest_name(const std::vector<std::string> &names, const std::string &name)
  {
    const auto nearest = std::min_element(names.begin(), names.end(),
                                          [&](const std::string &a, const std::string &b)
                                          { return edit_distance(a, name) < edit_distance(b, name); });
    return nearest == names.end() ? "" : *nearest;
  }

  void refuse_name(const std::string &message)
  {
    throw InputError(message);
  }
} // namespace Voussoir
