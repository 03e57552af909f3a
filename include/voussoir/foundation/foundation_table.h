// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_foundation_table_h
#define voussoir_foundation_table_h

#include <voussoir/foundation/foundation.h>

#include <memory>

namespace Voussoir
{
  /** Creates the foundation of FoundationParameters::model. Throws InputError for an unknown name, for a mesh
   * without the required rock, and the errors of the constructor of the foundation. */
  std::unique_ptr<Foundation> make_foundation(const FoundationSite &site);
} // namespace Voussoir

#endif
