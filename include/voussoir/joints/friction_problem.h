// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_friction_problem_h
#define voussoir_friction_problem_h

#include <voussoir/base/node_matrix.h>
#include <voussoir/joints/interface_operator.h>
#include <voussoir/joints/joint_laws.h>

#include <string>

namespace Voussoir
{
  /** Frictional contact problem gap = W force + q with Coulomb's law. Components are (n, t1, t2). */
  struct FrictionProblem
  {
    BlockSparseMatrix   W;     ///< [m/N], or other consistent units
    Unknowns            q;     ///< gap without forces, three values per contact
    std::vector<double> mu;    ///< coefficient of friction of each contact [-]
    Unknowns            guess; ///< initial guess of the force, three values per contact; may be empty
    std::string         title;
  };

  /** Returns the joint problem gap = W force + b of one step as a friction problem with Coulomb's law on
   * every surface, without initial guess. Any solver of such problems can check it.
   *
   * A pair with several surfaces (KSM) has one contact for each surface that can become active. The operator
   * is then A W A^T + C and the offset A b + c, with the surface axes A, the contact compliance C and the
   * clearances c. All laws must have flat_friction() or surfaces_law(). */
  FrictionProblem friction_problem(const InterfaceOperator &W, const PairLaws &laws,
                                   const std::vector<PairHistory> &history, const Unknowns &b);

  /** Writes a problem with its initial guess as text, with all digits. Throws WriteError. */
  void write_friction_problem(const std::string &file, const FrictionProblem &problem);
} // namespace Voussoir

#endif
