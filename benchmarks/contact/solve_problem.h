// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_solve_problem_h
#define voussoir_solve_problem_h

#include <voussoir/contact/contact_solver.h>
#include <voussoir/contact/law_parameters.h>
#include <voussoir/joints/friction_problem.h>

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
   * @param problem contact problem, for example from read_problem()
   * @param parameters parameters of the contact solver
   * @param equations form of Coulomb's law at each contact */
  FrictionSolution solve_friction_problem(const FrictionProblem &problem, const ContactParameters &parameters,
                                          Equations equations);
} // namespace Voussoir

#endif
