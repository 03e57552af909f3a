// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_load_names_h
#define voussoir_load_names_h

#include <string>

namespace Voussoir
{
  class Entries;
  struct LoadParameters;

  // From the rows of load_table.cc.

  /** Returns the names of all static loads, as in combinations: "weight, water, tail water". */
  std::string static_load_names();

  /** Returns the names with their help texts: "weight, water (with its added mass)". */
  std::string static_load_docs();

  /** Declares the entries of all static loads in subsections of "Loads". */
  void add_load_parameters(LoadParameters &loads, Entries &prm);
} // namespace Voussoir

#endif
