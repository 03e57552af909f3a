// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_figures_h
#define voussoir_figures_h

#include <string>

namespace Voussoir
{
  /** Draws the figures of a run with scripts/figures.py.
   * @param directory output directory of the run
   * @param log_file receives the output of the script
   *
   * Returns an error message, or an empty string.
   *
   * The script is in the directory $VOUSSOIR_SCRIPTS, if it is set, or else in that of the build or
   * installation. The interpreter is $VOUSSOIR_PYTHON, or else the first python3 of the PATH and of /usr/bin
   * with matplotlib. */
  std::string draw_figures_of(const std::string &directory, const std::string &log_file);
} // namespace Voussoir

#endif
