// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/program.h>

#include <algorithm>
#include <cstdlib>
#include <fcntl.h>
#include <unistd.h>

namespace
{
  /** Whether a command computes with threads. The others start twice as fast without wait_politely(). */
  bool uses_threads(const std::vector<std::string> &words)
  {
    const auto has = [&](const char *word)
    { return std::find(words.begin(), words.end(), word) != words.end(); };
    if (words.empty() || has("--validate") || has("--help") || has("--version"))
      return false;
    return words[0] != "contact" && words[0] != "parameters" && words[0] != "motion" && words[0] != "mesh";
  }

  /** Threads that wait for the others must not keep a core busy that another program needs: on a machine with
   *  other work, their usual long spinning makes a run ten times slower. The OpenMP library reads this
   * setting when it is loaded, so the program starts itself again with it. */
  void wait_politely(char *argv[])
  {
    if (std::getenv("GOMP_SPINCOUNT") == nullptr && std::getenv("OMP_WAIT_POLICY") == nullptr)
    {
      setenv("GOMP_SPINCOUNT", "1000", 1);
      execv("/proc/self/exe", argv); // comes back only if it fails, and then all is as before
    }
  }
} // namespace

int main(int argc, char *argv[])
{
  for (int file = 0; file < 3; ++file) // else the first file that is opened would be the screen
    if (fcntl(file, F_GETFD) < 0)
      open("/dev/null", O_RDWR);
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (uses_threads(words))
    wait_politely(argv);
  return Voussoir::run_program(words);
}
