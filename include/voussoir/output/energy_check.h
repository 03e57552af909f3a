// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_energy_check_h
#define voussoir_energy_check_h

#include <string>

namespace Voussoir
{
  struct Scene;

  /** Limit of the error of an energy balance, relative to the largest energy [-]. */
  constexpr double largest_balance_error = 1e-4;

  /** Throws ComputationError if the error of an energy balance exceeds largest_balance_error. Normal
   * runs have at most 1e-6.
   *
   * @param scene input file
   * @param dam, rock largest error of the run, relative to the largest energy [-]; 0: not present
   * @param directory output directory */
  void check_energies(const Scene &scene, double dam, double rock, const std::string &directory);
} // namespace Voussoir

#endif
