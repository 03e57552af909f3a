// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/program.h>

#include <algorithm>
#include <cstdlib>
#include <fcntl.h>
#include <unistd.h>

namespace
{
  /** Returns true if a command computes with threads. Others start twice as fast without wait_politely(). */
  bool uses_threads(const std::vector<std::string> &words)
  {
    const auto has = [&](const char *word)
    { return std::find(words.begin(), words.end(), word) != words.end(); };
    if (words.empty() || has("--validate") || has("--help") || has("--version"))
      return false;
    return words[0] != "contact" && words[0] != "parameters" && words[0] != "motion" && words[0] != "mesh";
  }

  /** Limits the active waiting of threads. On a loaded machine the default makes a run ten times slower. The
   * OpenMP library reads this setting when it is loaded, so the program restarts itself. */
  void wait_politely(char *argv[])
  {
    if (std::getenv("GOMP_SPINCOUNT") == nullptr && std::getenv("OMP_WAIT_POLICY") == nullptr)
    {
      setenv("GOMP_SPINCOUNT", "1000", 1);
      execv("/proc/self/exe",
            argv); // returns only on failure; the program then continues without the setting
    }
  }
} // namespace

int main(int argc, char *argv[])
{
  for (int file = 0; file < 3; ++file) // otherwise the first opened file would be the standard output
    if (fcntl(file, F_GETFD) < 0)
      open("/dev/null", O_RDWR);
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (uses_threads(words))
    wait_politely(argv);
  return Voussoir::run_program(words);
}
