// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/foundation/rock_balance.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  RockBalance::RockBalance(const ExplicitRegion &region, const bool is_subcycled)
      : entries(is_subcycled ? on_rock + 1 : on_rock, 0.), region(region), is_subcycled(is_subcycled)
  {
  }

  void RockBalance::update_largest()
  {
    const RegionEnergy e = of_rock();
    entries[largest_energy] = std::max({entries[largest_energy], e.kinetic + e.strain, e.damping,
                                        std::abs(e.prescribed + e.external), std::abs(e.transmitted)});
    entries[largest_error] = std::max(entries[largest_error], std::abs(e.balance()));
  }

  std::vector<std::pair<std::string, double>> RockBalance::columns() const
  {
    const RegionEnergy e = of_rock();
    return {{"rock_kinetic", e.kinetic},    {"rock_strain", e.strain},
            {"rock_damping", e.damping},    {"rock_feet", e.prescribed + e.external},
            {"transmitted", e.transmitted}, {"rock_balance", e.balance()},
            {"interface", coupling_error()}};
  }
} // namespace Voussoir
