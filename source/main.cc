#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>

#include <voussoir/command_line.h>
#include <voussoir/interrupt.h>
#include <voussoir/output_file.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <unistd.h>

namespace
{
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
  wait_politely(argv);
  std::signal(SIGXFSZ, SIG_IGN); // a file that may not grow is an error of the write
  try
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
    if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    {
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::cerr << "voussoir: error: This version runs on one rank: start it without mpirun. It uses all "
                     "cores, or as many as OMP_NUM_THREADS says."
                  << std::endl;
      return 2;
    }
    const int status = Voussoir::run_command(std::vector<std::string>(argv + 1, argv + argc));
    if (!std::cout.flush() || std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw Voussoir::WriteError::of("standard output");
    return status;
  }
  catch (const Voussoir::InputError &error)
  {
    std::cerr << "voussoir: error: " << error.what() << std::endl;
    return 2;
  }
  catch (const Voussoir::Interrupted &error)
  {
    std::cerr << "voussoir: stopped: " << error.what() << std::endl;
    return 1;
  }
  catch (const Voussoir::ComputationError &error)
  {
    std::cerr << "voussoir: failed: " << error.what() << std::endl;
    return 1;
  }
  catch (const std::bad_alloc &)
  {
    std::cerr << "voussoir: failed: there is not enough memory. Use fewer elements; --validate estimates "
                 "what is needed."
              << std::endl;
    return 1;
  }
  catch (const std::exception &error)
  {
    std::cerr << "voussoir: internal error, please report it: " << error.what() << std::endl;
    return 1;
  }
}
