// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_massless_rock_h
#define voussoir_massless_rock_h

#include <voussoir/foundation/foundation.h>

#include <memory>

namespace Voussoir
{
  /** Rock without mass, the foundation of the standard method of Clough (1980): adds to the dam, a
   * @p structure of one body, the stiffness of the rock of @p mesh, statically condensed to the nodes of the
   * dam's base and fixed at its artificial boundary. No waves; the earthquake moves that boundary, and
   * displacements are relative to it. The stiffness-proportional damping of the dam acts in the rock, too.
   *
   * @p dam: its base free. @p source names the mesh. Throws InputError where a node of the base has no rock,
   * ComputationError where nothing holds the rock. */
  void add_massless_rock(const FoundationParameters &parameters, const HexMesh &mesh, const SolidModel &dam,
                         bool incompatible_modes, const std::string &source, Structure &structure);

  /** That as a foundation. */
  std::unique_ptr<Foundation> make_massless_rock(const FoundationSite &site);
} // namespace Voussoir

#endif
