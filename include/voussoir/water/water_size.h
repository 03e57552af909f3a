// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_water_size_h
#define voussoir_water_size_h

#include <voussoir/base/error.h>

namespace Voussoir
{
  /** Water elements that are too large for the section. */
  struct CoarseWater : InputError
  {
    using InputError::InputError;
  };

  constexpr double bytes_per_water_node = 850.; ///< measured, see tests/program_memory.py
  constexpr double largest_mass_factor = 1.3;   ///< of the water, for time steps above the critical one [-]

  /** Returns the estimated number of nodes of the generated channel, see make_channel().
   * @param area section below the water level [m^2]
   * @param depth largest depth [m]
   * @param length part without damping [m]; 0: two depths
   * @param h size of the elements at the dam [m]; 0: a sixteenth of the depth */
  double channel_nodes(double area, double depth, double length, double h);
} // namespace Voussoir

#endif
