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
    /** Convergence and costs. The residual is the relative natural-map error of Siconos for the problem with
     * the mean diagonal of W scaled to 1 [-]. */
    ContactResult result;
    Unknowns      force;  ///< contact forces, three values per contact [N]
    Unknowns      gap;    ///< gaps W force + q, three values per contact [m]
    std::string   solver; ///< stages of the solution, such as `newton+sweeps` (Gauss-Seidel iterations)
  };

  /** Solves a friction problem, with zero forces as the initial guess. Problems with large groups of coupled
   * contacts, such as the joints of an arch, are solved in blocks of groups. Other problems are solved
   * directly.
   * @param problem contact problem, for example from read_fclib()
   * @param parameters parameters of the contact solver
   * @param equations form of Coulomb's law at each contact */
  FrictionSolution solve_friction_problem(const FrictionProblem &problem, const ContactParameters &parameters,
                                          Equations equations);

  /** Options of `voussoir contact`, as texts of the command line. */
  struct ContactOptions
  {
    std::string tolerance = "1e-12"; ///< largest relative residual [-]
    std::string solver = "newton";   ///< `newton`, `proximal`, `sweeps`, `paper` or `fischer-burmeister`
    std::string max_seconds = "10";  ///< largest CPU time for each problem [s]
    std::string solutions;           ///< directory for the contact forces; empty: not written
  };

  /** Runs `voussoir contact`: solves FCLib problems and prints one JSON object for each. A file that cannot be
   * read is reported on stderr, and the other files are solved.
   * @param files names of the FCLib files
   * @param options options of the command
   *
   * Throws InputError for an invalid option, and after all problems if a file cannot be read. Throws
   * ComputationError after all problems if a problem did not converge. */
  void run_contact(const std::vector<std::string> &files, const ContactOptions &options);
} // namespace Voussoir

#endif
