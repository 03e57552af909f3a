// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_load_names_h
#define voussoir_load_names_h

#include <string>

namespace Voussoir
{
  class Entries;
  struct LoadParameters;
  struct ModelChoices;
  struct Scene;

  // From the rows of load_table.cc.

  /** Returns the names of all static loads, as in combinations: "weight, water, tail water". */
  std::string static_load_names();

  /** Returns the names with their help texts: "weight, water (with its added mass)". */
  std::string static_load_docs();

  /** Adds the scene without each one of its loads, except weight and water. */
  void add_load_choices(const Scene &scene, ModelChoices &choices);

  /** Declares the entries of all static loads in subsections of "Loads". */
  void add_load_parameters(LoadParameters &loads, Entries &prm);
} // namespace Voussoir

#endif
