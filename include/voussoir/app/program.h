// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_program_h
#define voussoir_program_h

#include <string>
#include <vector>

namespace Voussoir
{
  /** Runs the command of the command line @p words, without the program name. Prints error messages on
   * stderr. Returns the exit status: 0 success, 1 failed or stopped, or internal error, 2 invalid input. */
  int run_program(const std::vector<std::string> &words);
} // namespace Voussoir

#endif
