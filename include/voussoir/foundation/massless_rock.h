// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_massless_rock_h
#define voussoir_massless_rock_h

#include <voussoir/foundation/foundation.h>

#include <memory>

namespace Voussoir
{
  /** Rock without mass, the foundation of the standard method of Clough (1980). No waves; the earthquake
   * moves its artificial boundary, and displacements are relative to that. The stiffness-proportional damping
   * of the dam acts in the rock, too.
   *
   * The rock is a body of its own: the monoliths stand on its compliance, which the problem of the joints has
   * eliminated (FootElimination). Where all joints are tied, and for what needs the operator of the joints
   * whole (FoundationSite::one_body), the monoliths are one body that has the condensed stiffness. */
  std::unique_ptr<Foundation> make_massless_rock(const FoundationSite &site);
} // namespace Voussoir

#endif
