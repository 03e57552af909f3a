// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/python_script.h>
#include <voussoir/output/figures.h>

namespace Voussoir
{
  namespace
  {
    constexpr int no_matplotlib = 3; ///< exit status of the script
  }

  std::string draw_figures_of(const std::string &directory, const std::string &log_file)
  {
    const std::filesystem::path script = find_script("figures.py");
    if (script.empty())
      return "the script figures.py was not found; the environment variable VOUSSOIR_SCRIPTS may name its "
             "directory";
    for (const std::string &python : python_interpreters())
    {
      const int status =
          run_process({python, script.string(), std::filesystem::absolute(directory).string()}, log_file);
      if (status == 0)
        return "";
      if (status == -1)
        return python + " cannot be started, or did not end by itself; see " + log_file;
      if (status != no_matplotlib)
        return "see " + log_file;
    }
    return "no python3 with numpy and matplotlib was found (on Debian: apt-get install python3-matplotlib); "
           "the environment variable VOUSSOIR_PYTHON may name one";
  }
} // namespace Voussoir
