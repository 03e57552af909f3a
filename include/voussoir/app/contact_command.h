// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_contact_command_h
#define voussoir_contact_command_h

#include <voussoir/contact/contact_solver.h>
#include <voussoir/contact/fclib_io.h>
#include <voussoir/contact/law_parameters.h>

namespace Voussoir
{
  /** Solution of a frictional contact problem. */
  struct FrictionSolution
  {
    ContactResult
        result; ///< residual: relative natural-map error of Siconos, with the mean diagonal of W scaled to 1
    Unknowns    force, gap; ///< three values per contact
    std::string solver;     ///< solvers in use, such as "newton+sweeps"
  };

  /** Solves a friction problem, starting from zero forces. Groups of coupled contacts, like the joints of an
   * arch, are solved joint by joint. Other problems are solved directly. @p equations: their form. */
  FrictionSolution solve_friction_problem(const FrictionProblem &problem, const ContactParameters &parameters,
                                          Equations equations);

  /** Options of `voussoir contact`. */
  struct ContactOptions
  {
    std::string tolerance = "1e-12", solver = "newton", max_seconds = "10"; ///< as on the command line
    std::string solutions;                                                  ///< output directory, or empty
  };

  /** Runs `voussoir contact`: solves the FCLib problems @p files and prints one JSON object for each. A file
   * that cannot be read is reported on stderr, and the other files are solved.
   *
   * Throws InputError for an unknown solver, and after all problems if a file cannot be read. Throws
   * ComputationError after all problems if a problem did not converge. */
  void run_contact(const std::vector<std::string> &files, const ContactOptions &options);
} // namespace Voussoir

#endif
