// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_energy_check_h
#define voussoir_energy_check_h

#include <string>

namespace Voussoir
{
  struct Scene;

  /** Throws ComputationError if the energies of a run do not balance: a sound run closes to 1e-7 or better,
   * more than 1e-4 is not to be trusted. @p dam, @p rock: largest |balance| of the run over the largest
   * energy (0 for what is not there); @p directory: where the results are. */
  void check_energies(const Scene &scene, double dam, double rock, const std::string &directory);
} // namespace Voussoir

#endif
