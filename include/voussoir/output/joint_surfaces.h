// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_surfaces_h
#define voussoir_joint_surfaces_h

#include <voussoir/dynamics/integrator.h>
#include <voussoir/solid/solid_model.h>

#include <string>

namespace Voussoir
{
  /** Writes the joints as surfaces for ParaView. Fields:
   *  - joint number, displacement of side 1 [m], opening [m], slip vector [m],
   *  - pressure (compression positive) and shear stress vector on side 1 [Pa], means over the step,
   *  - state: 0 open, 1 stick, 2 slip, -1 fixed base node.
   *
   * @param file name of the VTU file
   * @param model mesh of the dam
   * @param structure pairs of the joints
   * @param integrator state at the present time
   * @param states contact states of the pairs
   *
   * Throws WriteError if the file cannot be written. */
  void write_joint_surfaces(const std::string &file, const SolidModel &model, const Structure &structure,
                            const Integrator &integrator, const std::vector<PairState> &states);
} // namespace Voussoir

#endif
