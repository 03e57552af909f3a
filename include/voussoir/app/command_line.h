// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_command_line_h
#define voussoir_command_line_h

#include <string>
#include <vector>

namespace Voussoir
{
  /** Runs the command of the command line @p words, without the program name. Returns the exit status 0.
   * Throws InputError (status 2) or ComputationError (status 1). */
  int run_command(const std::vector<std::string> &words);

  /** Returns true if the command is a run, which can use several ranks. Returns false for invalid words. */
  bool runs_scene(const std::vector<std::string> &words);
} // namespace Voussoir

#endif
