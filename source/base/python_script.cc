// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/python_script.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <iostream>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

namespace Voussoir
{
  namespace fs = std::filesystem;

  namespace
  {
    std::string from_environment(const char *name)
    {
      const char *value = std::getenv(name);
      return value == nullptr ? "" : value;
    }

    /** Returns the null-terminated array that execv requires. */
    std::vector<char *> pointers_to(const std::vector<std::string> &words)
    {
      std::vector<char *> result;
      for (const std::string &word : words)
        result.push_back(const_cast<char *>(word.c_str()));
      result.push_back(nullptr);
      return result;
    }
  } // namespace

  fs::path find_script(const std::string &name)
  {
    const std::string     chosen = from_environment("VOUSSOIR_SCRIPTS");
    std::error_code       error;
    const fs::path        program = fs::read_symlink("/proc/self/exe", error).parent_path();
    std::vector<fs::path> places = {chosen};
    if (chosen.empty())
      places = {program / "scripts", program / "../scripts", program / "../share/voussoir/scripts"};
    for (const fs::path &place : places)
      if (fs::is_regular_file(place / name, error))
        return place / name;
    return {};
  }

  std::vector<std::string> python_interpreters()
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

  int run_process(const std::vector<std::string> &arguments, const std::string &output)
  {
    std::vector<char *>        words = pointers_to(arguments);
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

  void become_script(const std::string &name, const std::vector<std::string> &arguments,
                     const std::string &modules)
  {
    const fs::path script = find_script(name);
    if (script.empty())
      throw InputError("The script " + name +
                       " was not found. It belongs to the build, or to share/voussoir/scripts of the "
                       "installation. Set the environment variable VOUSSOIR_SCRIPTS to its directory.");
    std::error_code error;
    setenv("VOUSSOIR_PROGRAM", fs::read_symlink("/proc/self/exe", error).c_str(), 1);
    for (const std::string &python : python_interpreters())
    {
      if (!modules.empty() && run_process({python, "-c", "import " + modules}, "/dev/null") != 0)
        continue;
      std::vector<std::string> words = {python, script.string()};
      words.insert(words.end(), arguments.begin(), arguments.end());
      std::cout.flush();
      std::fflush(stdout);
      execv(python.c_str(), pointers_to(words).data());
      throw InputError(python + " cannot be started: " + std::strerror(errno) +
                       ". Set the environment variable VOUSSOIR_PYTHON to another interpreter.");
    }
    throw InputError("This command requires a python3" + (modules.empty() ? "" : " with " + modules) +
                     " (on Debian: apt-get install python3-matplotlib). Install it, or set the environment "
                     "variable VOUSSOIR_PYTHON to such an interpreter.");
  }
} // namespace Voussoir
