// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_mass_scaling_h
#define voussoir_mass_scaling_h

#include <voussoir/solid/structure.h>

namespace Voussoir
{
  /** Returns masses to add to the nodes, with which the critical step of the leapfrog rule is at least @p step [s].
   * Returns an empty vector if the structure has such a step already [kg].
   *
   * The sum of the absolute values of a row of the stiffness matrix, over the mass of the node, is an upper bound of the
   * square of a frequency (Gershgorin). A node receives mass where the bound exceeds a limit. The limit is the largest
   * one that gives the step, within 2 %.
   * @param without masses of nodes that do not count, as for critical_step() [kg] */
  std::vector<double> mass_scaling(const Structure &structure, const std::vector<Matrix3> &without,
                                   double step);
} // namespace Voussoir

#endif
