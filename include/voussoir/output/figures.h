// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_figures_h
#define voussoir_figures_h

#include <string>

namespace Voussoir
{
  /** Draws the figures of the run in @p directory with scripts/figures.py, which writes what it has to say to
   * @p log_file. The script is looked for in the directory $VOUSSOIR_SCRIPTS, else where the program's build
   * or its installation has it; the interpreter is $VOUSSOIR_PYTHON, else the first python3 of the PATH and
   * of /usr/bin that has matplotlib. No shell is involved. Returns what went wrong, or an empty text. */
  std::string draw_figures_of(const std::string &directory, const std::string &log_file);
} // namespace Voussoir

#endif
