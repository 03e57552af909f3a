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

  /** Returns the lowest rock of the column with the highest top. The angles of incident waves refer to this
   * rock. */
  Material half_space_of(const RockModel &model);

  /** Returns the travel time of a plane wave from the side of the rock that it reaches first to the place
   * @p to [s]. The path follows the same column. */
  double travel_time(const RockModel &model, const PlaneWave &wave, const Vector3 &to);

  /** Returns the waves with delays such that all of them, without their own delays, arrive at the place @p
   * to together, and that no wave is in the rock at the start. Delays count at the entrance of the lowest
   * column below Incidence::centre. */
  Incidence timed(const RockModel &model, const Incidence &incidence, const Vector3 &to);

  /** Returns the time at which the waves of timed() without their own delays arrive [s]. */
  double arrival_time(const RockModel &model, const Incidence &incidence, const Vector3 &to);
} // namespace Voussoir

#endif
