#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>

#include <voussoir/command_line.h>
#include <voussoir/error.h>

#include <exception>
#include <iostream>

int main(int argc, char *argv[])
{
  try
  {
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
    return Voussoir::run_command(std::vector<std::string>(argv + 1, argv + argc));
  }
  catch (const Voussoir::InputError &error)
  {
    std::cerr << "voussoir: error: " << error.what() << std::endl;
    return 2;
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
