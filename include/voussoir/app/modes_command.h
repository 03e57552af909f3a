// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_modes_command_h
#define voussoir_modes_command_h

#include <voussoir/dam/scene.h>

namespace Voussoir
{
  /** Runs `voussoir modes`: prints the natural frequencies of the tied dam.
   *
   * @param scene input file
   * @param count number of modes
   * @param directory for modes.csv with participation factors and effective masses, mode-NN.vtu, and figures;
   * empty: none
   * @param spectrum for a response spectrum analysis: "design" or a file, see choose_spectrum(); empty: none
   * @param json print a JSON object instead of the tables
   *
   * Throws InputError for an invalid count, for rock with mass, for a spectrum that cannot be used, and for a spectrum
   * with @p json. */
  void print_modes(const Scene &scene, const std::string &count, const std::string &directory,
                   const std::string &spectrum = "", bool json = false);

  /** Returns the first three natural frequencies of the tied dam with its water [Hz], on a rigid base instead of rock with
   * mass. */
  std::vector<double> first_frequencies(Scene scene);
} // namespace Voussoir

#endif
