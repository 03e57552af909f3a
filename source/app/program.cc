// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/multithread_info.h>

#include <voussoir/app/command_line.h>
#include <voussoir/app/program.h>
#include <voussoir/base/interrupt.h>
#include <voussoir/base/output_file.h>
#include <voussoir/base/ranks.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>

namespace Voussoir
{
  namespace
  {
    /** Rank and number of ranks, as mpirun of Open MPI, of MPICH and Intel (and Slurm's PMI-2), or srun tell
     *  them in the environment; 0 and 1 for a program that was started alone. */
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
  } // namespace

  namespace
  {
    /** Does what the words say; returns the status, and what is to be told of an error. */
    std::pair<int, std::string> run_guarded(const std::vector<std::string> &words)
    {
      try
      {
        const int status = run_command(words);
        errno = 0;
        if ((!std::cout.flush() || std::fflush(stdout) != 0 || std::ferror(stdout) != 0) && errno != EPIPE)
          throw WriteError("Standard output cannot be written. Is the disk full?");
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
        return {1,
                "voussoir: failed: there is not enough memory. Use fewer elements; --validate estimates what "
                "is needed."};
      }
      catch (const std::exception &error)
      {
        return {1, std::string("voussoir: internal error, please report it: ") + error.what()};
      }
    }
  } // namespace

  int run_program(const std::vector<std::string> &words)
  {
    // Nothing of a single process needs MPI, which takes longer to start than many a command to run.
    dealii::MultithreadInfo::set_thread_limit(1);
    if (const auto [rank, n_ranks] = rank_of_launcher(); n_ranks > 1)
    {
      if (runs_scene(words))
        Ranks::start(n_ranks);
      else if (rank != 0)
        return 0; // the first one does alone what is not a run
    }
    std::signal(SIGXFSZ, SIG_IGN); // a file that may not grow is an error of the write
    const auto [status, message] = run_guarded(words);
    if (!message.empty())
      std::cerr << message << std::endl;
    return Ranks::finish(status, message);
  }
} // namespace Voussoir
