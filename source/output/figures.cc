// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/output/figures.h>

#include <algorithm>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace Voussoir
{
  namespace fs = std::filesystem;

  namespace
  {
    constexpr int no_matplotlib = 3; ///< exit status of the script

    std::string from_environment(const char *name)
    {
      const char *value = std::getenv(name);
      return value == nullptr ? "" : value;
    }

    fs::path find_script()
    {
      const std::string     chosen = from_environment("VOUSSOIR_SCRIPTS");
      std::error_code       error;
      const fs::path        program = fs::read_symlink("/proc/self/exe", error).parent_path();
      std::vector<fs::path> places = {chosen};
      if (chosen.empty())
        places = {program / "scripts", program / "../scripts", program / "../share/voussoir/scripts"};
      for (const fs::path &place : places)
        if (fs::is_regular_file(place / "figures.py", error))
          return place / "figures.py";
      return {};
    }

    std::vector<std::string> interpreters()
    {
      if (const std::string chosen = from_environment("VOUSSOIR_PYTHON"); !chosen.empty())
        return {chosen};
      std::vector<std::string> found;
      std::istringstream       path(from_environment("PATH") + ":/usr/bin");
      for (std::string directory; std::getline(path, directory, ':');)
      {
        const std::string python = directory + "/python3";
        if (directory.compare(0, 1, "/") == 0 && access(python.c_str(), X_OK) == 0 &&
            std::find(found.begin(), found.end(), python) == found.end())
          found.push_back(python);
      }
      return found;
    }

    /** Runs a program and returns its exit status, -1 if it could not be started or did not end by itself. */
    int run(const std::vector<std::string> &arguments, const std::string &output)
    {
      std::vector<char *> words;
      for (const std::string &argument : arguments)
        words.push_back(const_cast<char *>(argument.c_str()));
      words.push_back(nullptr);
      posix_spawn_file_actions_t actions;
      posix_spawn_file_actions_init(&actions);
      posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
      posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                       0666);
      posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
      pid_t     child = 0;
      const int error = posix_spawnp(&child, words[0], &actions, nullptr, words.data(), environ);
      posix_spawn_file_actions_destroy(&actions);
      int status = 0;
      if (error != 0 || waitpid(child, &status, 0) != child || !WIFEXITED(status))
        return -1;
      return WEXITSTATUS(status);
    }
  } // namespace

  std::string draw_figures_of(const std::string &directory, const std::string &log_file)
  {
    const fs::path script = find_script();
    if (script.empty())
      return "the script figures.py was not found; the environment variable VOUSSOIR_SCRIPTS may name its "
             "directory";
    for (const std::string &python : interpreters())
    {
      const int status = run({python, script.string(), fs::absolute(directory).string()}, log_file);
      if (status == 0)
        return "";
      if (status == -1)
        return python + " cannot be started, or did not end by itself; see " + log_file;
      if (status != no_matplotlib)
        return "see " + log_file;
    }
    return "no python3 with numpy and matplotlib was found (on Debian: apt-get install python3-matplotlib); "
           "the "
           "environment variable VOUSSOIR_PYTHON may name one";
  }
} // namespace Voussoir
