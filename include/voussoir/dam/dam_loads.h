// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_dam_loads_h
#define voussoir_dam_loads_h

#include <voussoir/solid/structure.h>

namespace Voussoir
{
  /** Adds the weight of the concrete to @p load: lumped mass times @p gravity [m/s^2], downwards [N]. */
  void add_weight(const Structure &structure, double gravity, Unknowns &load);

  /** Returns the inertia loads for a unit acceleration of the base along each axis, -M iota [N s^2/m]. */
  std::array<Unknowns, 3> inertial_loads(const Structure &structure);
} // namespace Voussoir

#endif
