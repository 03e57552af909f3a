// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_modes_h
#define voussoir_modes_h

#include <voussoir/solid/structure.h>

namespace Voussoir
{
  /** The lowest natural frequencies of a structure without pairs [Hz], ascending: K phi = omega^2 M phi by
   * ARPACK, inverse iteration. Throws ComputationError when it does not converge. */
  std::vector<double> natural_frequencies(const Structure &structure, unsigned int n_modes);
} // namespace Voussoir

#endif
