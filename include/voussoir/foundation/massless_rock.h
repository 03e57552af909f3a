// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_massless_rock_h
#define voussoir_massless_rock_h

#include <voussoir/foundation/foundation.h>

#include <memory>

namespace Voussoir
{
  /** Creates massless rock for the @p site, the foundation of the standard method of Clough (1980). There
   * are no waves. The ground motion is prescribed at the outer boundary of the rock, and displacements are
   * relative to this boundary. The stiffness-proportional damping of the dam acts in the rock, too.
   *
   * Base nodes are coupled (BaseSupport::Base). The joint problem eliminates the compliance of the rock at
   * the base nodes (BaseElimination). With FoundationSite::one_body, base nodes are merged, and dam and rock
   * are one body with the condensed stiffness of the rock. */
  std::unique_ptr<Foundation> make_massless_rock(const FoundationSite &site);
} // namespace Voussoir

#endif
