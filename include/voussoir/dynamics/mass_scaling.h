// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_mass_scaling_h
#define voussoir_mass_scaling_h

#include <voussoir/solid/structure.h>

namespace Voussoir
{
  /** Returns the masses to add to the nodes of a structure so that the critical step of the leapfrog rule becomes @p step
   * [s]; empty if it is as long without them [kg]. A node receives mass where the sum of the absolute values of its row of
   * the stiffness matrix over its mass, an upper bound of the square of a frequency (Gershgorin), exceeds a limit. The
   * limit is the largest one that gives the step, within 2 %.
   * @param without masses of nodes that do not count, as for critical_step() [kg] */
  std::vector<double> mass_scaling(const Structure &structure, const std::vector<Matrix3> &without,
                                   double step);
} // namespace Voussoir

#endif
