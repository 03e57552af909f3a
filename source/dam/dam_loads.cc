// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/dam/dam_loads.h>

namespace Voussoir
{
  void add_weight(const Structure &structure, const double gravity, Unknowns &load)
  {
    for (unsigned int i = 0; i < structure.n_nodes(); ++i)
      load[3 * i + 2] -= gravity * (structure.mass[i][8] - structure.added_mass[i][8]);
  }

  std::array<Unknowns, 3> inertial_loads(const Structure &structure)
  {
    std::array<Unknowns, 3> loads;
    for (unsigned int d = 0; d < 3; ++d)
    {
      loads[d].resize(3 * structure.n_nodes());
      for (unsigned int i = 0; i < structure.n_nodes(); ++i)
        for (unsigned int c = 0; c < 3; ++c)
          loads[d][3 * i + c] = -structure.mass[i][3 * c + d];
      structure.remove_held_forces(loads[d]);
    }
    return loads;
  }
} // namespace Voussoir
