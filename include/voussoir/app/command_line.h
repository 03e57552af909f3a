// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_command_line_h
#define voussoir_command_line_h

#include <string>
#include <vector>

namespace Voussoir
{
  /** Does what the words of the command line (without the program's name) say. Returns the exit status 0;
   * everything else leaves by InputError (status 2) or ComputationError (status 1). */
  int run_command(const std::vector<std::string> &words);

  /** Do the words ask for the run of a scene, which several ranks do together? False for bad words, too. */
  bool runs_scene(const std::vector<std::string> &words);
} // namespace Voussoir

#endif
