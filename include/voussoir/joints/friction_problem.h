// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_friction_problem_h
#define voussoir_friction_problem_h

#include <voussoir/contact/fclib_io.h>
#include <voussoir/joints/interface_operator.h>
#include <voussoir/joints/joint_laws.h>

namespace Voussoir
{
  /** Returns the joint problem gap = W force + b of one step as a friction problem with Coulomb's law on
   * every surface. Any solver of such problems can check it.
   *
   * A pair with several surfaces (KSM) has one contact for each surface that can become active. The operator
   * is then A W A^T + C and the offset A b + c, with the surface axes A, the contact compliance C and the
   * clearances c. All laws must have flat_friction() or surfaces_law(). */
  FrictionProblem friction_problem(const InterfaceOperator &W, const PairLaws &laws,
                                   const std::vector<PairHistory> &history, const Unknowns &b);
} // namespace Voussoir

#endif
