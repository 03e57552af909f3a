// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_modes_command_h
#define voussoir_modes_command_h

#include <voussoir/dam/scene.h>

namespace Voussoir
{
  /** `voussoir modes`: the natural frequencies of the tied dam on standard output; in @p directory, where it
   * is not empty, modes.csv with participation factors and effective masses, mode-NN.vtu, and figures.
   * InputError for a count that is none, and for rock with mass. */
  void print_modes(const Scene &scene, const std::string &count, const std::string &directory);
} // namespace Voussoir

#endif
