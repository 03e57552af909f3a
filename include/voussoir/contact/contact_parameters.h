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
  struct ModelChoices;

  /** Parameters of the contact solver: subsection "Contact" of the input file. */
  struct ContactParameters
  {
    double       tolerance = 1e-10;    ///< relative residual at which a solution is accepted [-]
    unsigned int max_iterations = 500; ///< largest number of Newton steps of a problem [-]
    unsigned int sweeps = 4;           ///< number of Gauss-Seidel iterations before the first Newton step [-]
    std::string  method = "newton";    ///< newton with its fallbacks; proximal, or sweeps (Gauss-Seidel)
    double       max_seconds = std::numeric_limits<double>::infinity(); ///< limit of CPU time per problem [s]
    bool         write_problems = false; ///< true: write problems for voussoir-contact
    unsigned int write_interval = 1;     ///< every N-th problem is written, where N is this number [-]
    std::string  write_directory;        ///< directory of these problems; set by the run, not an entry
    unsigned int first_problem = 0; ///< number of problems before a resumed run; set by the run, not an entry

    /** Declares the entries of subsection "Contact". */
    void add_parameters(dealii::ParameterHandler &prm);

    /** Adds another tolerance. */
    void add_choices(ModelChoices &choices) const;
  };
} // namespace Voussoir

#endif
