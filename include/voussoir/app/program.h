// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_program_h
#define voussoir_program_h

#include <string>
#include <vector>

namespace Voussoir
{
  /** The program with the command line @p words (without its own name): runs the command, prints the messages
   * of errors on stderr and returns the exit status: 0 done; 1 the computation failed or was stopped; 2 bad
   * input, or more than one rank. Anything else that is thrown is a bug and says so (status 1). */
  int run_program(const std::vector<std::string> &words);
} // namespace Voussoir

#endif
