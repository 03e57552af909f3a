// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_foundation_table_h
#define voussoir_foundation_table_h

#include <voussoir/foundation/foundation.h>
#include <voussoir/foundation/foundation_names.h>

#include <memory>

namespace Voussoir
{
  /** The foundation of the model that the parameters name: rigid, rock, massless. Throws InputError for an
   * unknown name, and for a mesh that does not fit it. */
  std::unique_ptr<Foundation> make_foundation(const FoundationSite &site);
} // namespace Voussoir

#endif
