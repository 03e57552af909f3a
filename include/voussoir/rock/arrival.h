// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_arrival_h
#define voussoir_arrival_h

#include <voussoir/rock/rock_model.h>

namespace Voussoir
{
  /** Returns the height at which the incident wave enters @p column: one cell below its lowest node [m]. */
  double entrance(const RockColumn &column);

  /** Returns the travel times of the rising S, S and P waves (motion in x, y and z) from the lowest
   * entrance() of all columns to the height @p z [s]. The path follows the column with the highest top,
   * which also supplies the free field of the bottom. Returns zeros if the model has no columns. */
  Vector3 travel_times(const RockModel &model, double z);
} // namespace Voussoir

#endif
