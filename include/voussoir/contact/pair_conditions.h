// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_pair_conditions_h
#define voussoir_pair_conditions_h

#include <voussoir/contact/joint_law.h>

namespace Voussoir
{
  // Components of joint laws: the equations of single conditions and exact solutions of one pair. Equation
  // numbers refer to the paper of 2008. Units: forces [N], openings and slips [m], rho [N/m], friction [-].

  /** Computes the normal condition in the form of Alart and Curnier, equation (2b): force_n = max(0, force_n
   * - rho gap_n). Returns whether the pair is closed, as equations.active. */
  bool normal_condition(double force, double opening, double rho, PairEquations &equations);

  /** Computes the equations of a pair without slip, (5) and (6). */
  void no_slip(double slip_a, double slip_b, double rho, PairEquations &equations);

  /** Computes the equations of Coulomb's law by Alart and Curnier.
   * @param force force of the pair [N]
   * @param opening opening [m]
   * @param slip tangential displacement of the step [m]
   * @param friction coefficient of friction [-]
   * @param rho scaling factor [N/m]
   * @param equations receives the result */
  void alart_curnier(const Vector3 &force, double opening, const std::array<double, 2> &slip, double friction,
                     double rho, PairEquations &equations);

  /** Returns the error of Coulomb's law, the natural map of De Saxce [N]: force - P(force - rho (u + mu |u_t| n)). P
   * is the projection onto the friction cone, and u (@p moved) consists of opening and slip [m]. */
  Vector3 natural_map(const Vector3 &force, const Vector3 &moved, double friction, double rho);

  /** Returns the exact solution of Coulomb's law at one pair [N]: gap = H force + b, gap_n >= 0, friction
   * against the tangential gap. @p H must be symmetric positive definite. */
  Vector3 solve_coulomb(const Matrix3 &H, const Vector3 &b, double friction);

  /** Returns the forces that make the marked components of H f + b zero. The other components of the
   * force are zero. */
  Vector3 tie_rows(Matrix3 H, Vector3 b, const std::array<bool, 3> &tied);
} // namespace Voussoir

#endif
