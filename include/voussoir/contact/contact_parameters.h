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
  /** Section "Contact" of a scene: the solver of the joint conditions. */
  struct ContactParameters
  {
    double       tolerance = 1e-10;    ///< relative residual that is accepted
    unsigned int max_iterations = 500; ///< Newton steps in all
    unsigned int sweeps = 4;           ///< Gauss-Seidel sweeps before the first Newton step
    std::string  method = "newton";    ///< newton (with its fallbacks), proximal, sweeps
    double       max_seconds = std::numeric_limits<double>::infinity(); ///< of CPU time
    bool         write_problems = false;                                ///< in FCLib's format
    unsigned int first_problem = 0;  ///< numbers of the files begin after it
    unsigned int write_interval = 1; ///< of the problems
    std::string  write_directory;    ///< not an entry: set by the run

    void               add_parameters(dealii::ParameterHandler &prm);
    static std::string method_names(); ///< as a ParameterHandler selection
  };
} // namespace Voussoir

#endif
