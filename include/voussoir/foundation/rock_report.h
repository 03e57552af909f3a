// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_report_h
#define voussoir_rock_report_h

#include <voussoir/base/log.h>
#include <voussoir/dynamics/time_grid.h>
#include <voussoir/foundation/foundation_parameters.h>
#include <voussoir/rock/rock_model.h>

namespace Voussoir
{
  /** Writes properties and warnings of explicit rock to the log.
   *
   * @param parameters parameters of the rock
   * @param model rock model
   * @param grid time steps; none: without earthquake
   * @param delay travel time of the ground motion to the lowest base node [s]
   * @param log receives the lines */
  void report_rock(const FoundationParameters &parameters, const RockModel &model, const TimeGrid &grid,
                   double delay, Log &log);
} // namespace Voussoir

#endif
