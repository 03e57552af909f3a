// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_friction_problem_h
#define voussoir_friction_problem_h

#include <voussoir/contact/fclib_io.h>
#include <voussoir/joints/interface_operator.h>
#include <voussoir/joints/joint_laws.h>

namespace Voussoir
{
  /** The problem of one step, gap = W force + b, as one with Coulomb's law on every surface, which any solver
   *  of such problems can check. Pairs with several surfaces (KSM) give one contact for each that can touch:
   *  A W A^T + C and A b + c, A: the surfaces' axes, C: compliance of the seats, c: clearances. All laws must
   *  have flat_friction() or surfaces_law(). */
  FrictionProblem friction_problem(const InterfaceOperator &W, const PairLaws &laws,
                                   const std::vector<PairPast> &past, const Unknowns &b);
} // namespace Voussoir

#endif
