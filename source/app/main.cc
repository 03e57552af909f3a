// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/multithread_info.h>

#include <voussoir/app/command_line.h>
#include <voussoir/base/interrupt.h>
#include <voussoir/base/output_file.h>
#include <voussoir/base/ranks.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fcntl.h>
#include <iostream>
#include <new>
#include <unistd.h>

namespace
{
  using namespace Voussoir;

  /** Returns true if a command computes with threads. Others start twice as fast without restart_with_settings(). */
  bool uses_threads(const std::vector<std::string> &words)
  {
    const auto has = [&](const char *word)
    { return std::find(words.begin(), words.end(), word) != words.end(); };
    if (words.empty() || has("--validate") || has("--help") || has("--version"))
      return false;
    const std::vector<std::string> quick = {"parameters", "motion", "mesh",      "scene",
                                            "new",        "arcs",   "completion"};
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

  /** Returns rank and number of ranks from the environment variables of Open MPI, MPICH and Intel (PMI), or
   * srun. Returns 0 and 1 without these variables. */
  std::pair<int, int> rank_of_launcher()
  {
    constexpr const char *names[][2] = {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                                        {"PMI_RANK", "PMI_SIZE"},
                                        {"SLURM_PROCID", "SLURM_STEP_NUM_TASKS"}};
    for (const auto &[rank, size] : names)
      if (std::getenv(rank) != nullptr && std::getenv(size) != nullptr)
        return {std::atoi(std::getenv(rank)), std::atoi(std::getenv(size))};
    return {0, 1};
  }

  /** Removes the variables of the launcher. Otherwise child processes, such as scripts and their runs,
   * would wait for the other ranks. */
  void forget_launcher()
  {
    std::vector<std::string> names = {"SLURM_PROCID", "SLURM_STEP_NUM_TASKS"};
    for (char **entry = environ; *entry != nullptr; ++entry)
    {
      const std::string name(*entry, std::strcspn(*entry, "="));
      for (const std::string begin : {"OMPI_COMM_WORLD_", "OMPI_MCA_", "OMPI_UNIVERSE_", "PMIX_", "PMI_"})
        if (name.compare(0, begin.size(), begin) == 0)
          names.push_back(name);
    }
    for (const std::string &name : names)
      unsetenv(name.c_str());
  }
  /** Runs the command. Returns the exit status and the message of an error. */
  std::pair<int, std::string> run_guarded(const std::vector<std::string> &words, const int n_ranks)
  {
    try
    {
      Ranks::start(n_ranks);
      const int status = run_command(words);
      errno = 0;
      if ((!std::cout.flush() || std::fflush(stdout) != 0 || std::ferror(stdout) != 0) && errno != EPIPE)
        throw WriteError(
            "Standard output cannot be written. Free disk space, or redirect the output to another file.");
      return {status, ""};
    }
    catch (const Ranks::FailedElsewhere &)
    {
      return {1, ""};
    }
    catch (const InputError &error)
    {
      return {2, std::string("voussoir: error: ") + error.what()};
    }
    catch (const Interrupted &error)
    {
      return {1, std::string("voussoir: stopped: ") + error.what()};
    }
    catch (const ComputationError &error)
    {
      return {1, std::string("voussoir: failed: ") + error.what()};
    }
    catch (const std::bad_alloc &)
    {
      return {1, "voussoir: failed: there is not enough memory. Use fewer elements. --validate estimates "
                 "the required memory."};
    }
    catch (const std::exception &error)
    {
      return {1, std::string("voussoir: internal error, please report it: ") + error.what()};
    }
  }

  /** Runs the command of the command line @p words, without the program name. Prints error messages on stderr. Returns
   * the exit status: 0 success, 1 failed or stopped, or internal error, 2 invalid input. */
  int run_program(const std::vector<std::string> &words)
  {
    // A single process does not need MPI, whose start may take longer than a command.
    dealii::MultithreadInfo::set_thread_limit(1);
    const auto [rank, n_launched] = rank_of_launcher();
    const bool is_shared = n_launched > 1 && runs_scene(words);
    if (n_launched > 1 && !is_shared)
    {
      if (rank != 0)
        return 0; // commands other than runs use the first rank only
      forget_launcher();
    }
    std::signal(SIGXFSZ, SIG_IGN); // a file size limit is reported by the write operation
    const auto [status, message] = run_guarded(words, is_shared ? n_launched : 1);
    if (!message.empty())
      std::cerr << message << std::endl;
    return Ranks::finish(status, message);
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
  return run_program(words);
}
