// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_foundation_names_h
#define voussoir_foundation_names_h

#include <string>

namespace Voussoir
{
  // From the rows of foundation_table.cc.

  /** Returns the names of all foundations as a selection of ParameterHandler: "rigid|rock|massless". */
  std::string foundation_names();

  /** Returns the help texts of all foundations, for the entry "Foundation/Model". */
  std::string foundation_docs();

  /** Returns whether the foundation uses the entry, such as "Foundation/Density". */
  bool foundation_reads(const std::string &model, const std::string &entry);
} // namespace Voussoir

#endif
