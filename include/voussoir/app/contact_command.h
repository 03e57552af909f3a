// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_contact_command_h
#define voussoir_contact_command_h

#include <voussoir/contact/contact_solver.h>
#include <voussoir/contact/fclib_io.h>
#include <voussoir/contact/law_parameters.h>

namespace Voussoir
{
  struct FrictionSolution
  {
    ContactResult
             result; ///< residual: Siconos' full relative natural-map error, mean diagonal of W scaled to 1
    Unknowns force, gap;
    std::string solver; ///< what it took: "newton", "newton+sweeps", ...
  };

  /** Solves a friction problem from zero forces. @p equations: of the contacts. Pairs that are coupled in
   *  groups, like those of the joints of an arch, are solved joint by joint, others directly. */
  FrictionSolution solve_friction_problem(const FrictionProblem &problem, const ContactParameters &parameters,
                                          Equations equations);

  struct ContactOptions
  {
    std::string tolerance = "1e-12", solver = "newton", max_seconds = "10"; ///< as on the command line
    std::string solutions;                                                  ///< directory, may be empty
  };

  /** `voussoir contact`: solves the FCLib problems @p files and prints a JSON object for each. Of several
   * files, one that cannot be read is named on stderr and the others are solved. Throws InputError for
   * unknown solvers, and at the end if a file cannot be read; ComputationError at the end if problems did not
   * converge. */
  void run_contact(const std::vector<std::string> &files, const ContactOptions &options);
} // namespace Voussoir

#endif
