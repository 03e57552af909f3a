// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_contact_parameters_h
#define voussoir_contact_parameters_h

#include <limits>
#include <string>

namespace dealii
{
  class ParameterHandler;
}

namespace Voussoir
{
  /** Parameters of the contact solver: subsection "Contact" of the input file. */
  struct ContactParameters
  {
    double       tolerance = 1e-10;    ///< relative residual at which a solution is accepted [-]
    unsigned int max_iterations = 500; ///< largest number of Newton steps of a problem
    unsigned int sweeps = 4;           ///< Gauss-Seidel iterations before the first Newton step
    std::string  method = "newton";    ///< newton (with its fallbacks), proximal, sweeps
    double       max_seconds = std::numeric_limits<double>::infinity(); ///< limit of CPU time per problem [s]
    bool         write_problems = false;                                ///< whether to write FCLib files
    unsigned int first_problem = 0;  ///< problems solved before a resumed run
    unsigned int write_interval = 1; ///< one of this many problems is written
    std::string  write_directory;    ///< set by the run, not an entry

    void               add_parameters(dealii::ParameterHandler &prm);
    static std::string method_names(); ///< ParameterHandler selection
  };
} // namespace Voussoir

#endif
