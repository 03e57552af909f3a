// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_python_script_h
#define voussoir_python_script_h

#include <filesystem>
#include <string>
#include <vector>

namespace Voussoir
{
  /** The program's own script @p name: in the directory $VOUSSOIR_SCRIPTS, else where the program's build or
   * its installation has it; empty if it is nowhere. */
  std::filesystem::path find_script(const std::string &name);

  /** $VOUSSOIR_PYTHON, else each python3 of the PATH and of /usr/bin, without repetition. */
  std::vector<std::string> python_interpreters();

  /** Runs a program, no shell involved, with what it prints in the file @p output. Returns its exit status,
   * -1 if it could not be started or did not end by itself. */
  int run_process(const std::vector<std::string> &arguments, const std::string &output);

  /** Goes on as the script @p name, in place of this program: signals, terminal and exit status are the
   * script's. It is started with @p arguments and finds this program in the environment variable
   * VOUSSOIR_PROGRAM. InputError if the script is missing, or a python3 with numpy and matplotlib. */
  [[noreturn]] void become_script(const std::string &name, const std::vector<std::string> &arguments);
} // namespace Voussoir

#endif
