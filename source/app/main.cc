// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/program.h>

#include <algorithm>
#include <cstdlib>
#include <fcntl.h>
#include <unistd.h>

namespace
{
  /** Returns true if a command computes with threads. Others start twice as fast without restart_with_settings(). */
  bool uses_threads(const std::vector<std::string> &words)
  {
    const auto has = [&](const char *word)
    { return std::find(words.begin(), words.end(), word) != words.end(); };
    if (words.empty() || has("--validate") || has("--help") || has("--version"))
      return false;
    const std::vector<std::string> quick = {"parameters", "motion", "mesh", "scene", "new", "arcs"};
    return std::find(quick.begin(), quick.end(), words[0]) == quick.end();
  }

  /** Restarts the program with settings that libraries read when they are loaded, unless the user has set them:
   * - GOMP_SPINCOUNT limits the active waiting of threads. On a loaded machine the default of the OpenMP library makes
   *   a run ten times slower.
   * - GLIBC_TUNABLES places large arrays in huge pages, also where the system does this on request only (THP
   *   "madvise"). The matrices then require fewer translations of addresses. */
  void restart_with_settings(char *argv[])
  {
    constexpr const char *restarted = "VOUSSOIR_RESTARTED"; // prevents a loop if the system removes a setting
    bool                  is_new = false;
    const auto            set = [&](const char *name, const char *value)
    {
      if (std::getenv(name) == nullptr)
        is_new = setenv(name, value, 1) == 0 || is_new;
    };
    if (std::getenv("OMP_WAIT_POLICY") == nullptr)
      set("GOMP_SPINCOUNT", "1000");
    set("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1");
    if (is_new && std::getenv(restarted) == nullptr && setenv(restarted, "1", 1) == 0)
      execv("/proc/self/exe", argv); // returns only on failure; the program then continues
  }
} // namespace

int main(int argc, char *argv[])
{
  for (int file = 0; file < 3; ++file) // otherwise the first opened file would be the standard output
    if (fcntl(file, F_GETFD) < 0)
      open("/dev/null", O_RDWR);
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (uses_threads(words))
    restart_with_settings(argv);
  return Voussoir::run_program(words);
}
