// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_completion_h
#define voussoir_completion_h

#include <iosfwd>
#include <string>
#include <vector>

namespace Voussoir
{
  /** Prints the completion of all commands, options, files and entries as a script of bash: `voussoir
   * completion bash`. Throws InputError unless @p words is "bash". */
  void print_completion(const std::vector<std::string> &words, std::ostream &out);
} // namespace Voussoir

#endif
