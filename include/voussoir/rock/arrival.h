// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_arrival_h
#define voussoir_arrival_h

#include <voussoir/rock/rock_model.h>

namespace Voussoir
{
  /** Height at which the rising wave enters a column: one cell below its foot [m]. */
  double entrance(const RockColumn &column);

  /** Travel times of the rising waves, S, S, P, from the lowest entrance to the height @p z, along the column
   * with the highest top, from which the free field of the bottom comes [s]. */
  Vector3 travel_times(const RockModel &model, double z);
} // namespace Voussoir

#endif
