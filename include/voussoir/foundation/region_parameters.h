// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_region_parameters_h
#define voussoir_region_parameters_h

#include <voussoir/foundation/foundation_parameters.h>
#include <voussoir/rock/rock_parameters.h>

namespace Voussoir
{
  /** Returns the rock parameters of the input file.
   *
   * @param p parameters of the input file
   * @param centre centre of the dam base [m]
   * @param dt time step of the rock [s] */
  RockRegionParameters region_parameters(const FoundationParameters &p, const std::array<double, 3> &centre,
                                         double dt);
} // namespace Voussoir

#endif
