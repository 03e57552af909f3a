// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_python_script_h
#define voussoir_python_script_h

#include <filesystem>
#include <string>
#include <vector>

namespace Voussoir
{
  /** Returns the path of the script @p name of this program. The script is searched in the directory
   * $VOUSSOIR_SCRIPTS if that is set, else in the build and installation directories. Returns an empty path
   * if there is no such script. */
  std::filesystem::path find_script(const std::string &name);

  /** Returns $VOUSSOIR_PYTHON if that is set. Otherwise returns each python3 in PATH and
   * /usr/bin, without repetition. */
  std::vector<std::string> python_interpreters();

  /** Runs a program without a shell and writes its stdout and stderr to the file @p output. Returns the exit
   * status, or -1 if the program could not be started or was ended by a signal. */
  int run_process(const std::vector<std::string> &arguments, const std::string &output);

  /** Replaces this process by the script @p name with @p arguments. Signals, terminal and exit status then
   * belong to the script. The script finds this program in the environment variable VOUSSOIR_PROGRAM. Throws
   * InputError if the script, or a python3 with the @p modules ("numpy, matplotlib"), is missing. */
  [[noreturn]] void become_script(const std::string &name, const std::vector<std::string> &arguments,
                                  const std::string &modules);
} // namespace Voussoir

#endif
