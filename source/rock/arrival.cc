// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/rock/arrival.h>
#include <voussoir/rock/free_field_column.h>

#include <algorithm>

namespace Voussoir
{
  double entrance(const RockColumn &column)
  {
    return 2. * column.z[0] - column.z[1];
  }

  Vector3 travel_times(const RockModel &model, const double z)
  {
    const auto &columns = model.columns;
    if (columns.empty())
      return {};
    const auto &column =
        *std::max_element(columns.begin(), columns.end(),
                          [](const RockColumn &a, const RockColumn &b) { return a.z.back() < b.z.back(); });
    double at = entrance(column);
    for (const RockColumn &c : columns)
      at = std::min(at, entrance(c));
    Vector3 times{};
    for (std::size_t k = 0; k < column.material.size() && at < z; ++k)
    {
      const double  next = std::max(at, std::min(z, column.z[k + 1]));
      const Vector3 speeds = wave_speeds(column.material[k]);
      for (unsigned int c = 0; c < 3; ++c)
        times[c] += (next - at) / speeds[c];
      at = next;
    }
    return times;
  }
} // namespace Voussoir
