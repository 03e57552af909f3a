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
      return "the script figures.py was not found. Set the environment variable VOUSSOIR_SCRIPTS to its "
             "directory";
    for (const std::string &python : python_interpreters())
    {
      const int status =
          run_process({python, script.string(), std::filesystem::absolute(directory).string()}, log_file);
      if (status == 0)
        return "";
      if (status == -1)
        return python + " cannot be started, or was stopped; see " + log_file;
      if (status != no_matplotlib)
        return "see " + log_file;
    }
    return "no python3 with numpy and matplotlib was found. Install it (on Debian: apt-get install "
           "python3-matplotlib), or set the environment variable VOUSSOIR_PYTHON";
  }
} // namespace Voussoir
