// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_surfaces_h
#define voussoir_joint_surfaces_h

#include <voussoir/dynamics/newmark.h>
#include <voussoir/solid/solid_model.h>

#include <string>

namespace Voussoir
{
  /** Writes the joints as surfaces, for ParaView: joint, displacement of side 1 [m], opening [m], slip (a
   * vector in space) [m], pressure (compression positive) [Pa] and shear stress (a vector: what side 1 feels)
   * [Pa], both means over the step, and state (0 open, 1 stick, 2 slip; -1 where the foot is held). */
  void write_joint_surfaces(const std::string &file, const SolidModel &model, const Structure &structure,
                            const Newmark &newmark, const std::vector<PairState> &states);
} // namespace Voussoir

#endif
