// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_foundation_names_h
#define voussoir_foundation_names_h

#include <string>

namespace Voussoir
{
  // From the rows of foundation_table.cc.
  std::string foundation_names(); ///< as a ParameterHandler selection: "rigid|rock|massless"
  std::string foundation_docs();  ///< a clause each, for the entry that selects one

  bool foundation_reads(const std::string &model, const std::string &entry); ///< "Foundation/Density"
} // namespace Voussoir

#endif
