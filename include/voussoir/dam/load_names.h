// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_load_names_h
#define voussoir_load_names_h

#include <string>

namespace Voussoir
{
  class Entries;
  struct LoadParameters;

  // From the rows of load_table.cc.
  std::string static_load_names(); ///< of combinations: "weight, water, tail water"
  std::string static_load_docs();  ///< the same with what their help adds
  void        add_load_parameters(LoadParameters &loads, Entries &prm); ///< their subsections of "Loads"
} // namespace Voussoir

#endif
