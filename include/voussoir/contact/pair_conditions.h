// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_pair_conditions_h
#define voussoir_pair_conditions_h

#include <voussoir/contact/joint_law.h>

namespace Voussoir
{
  // What joint laws are made of: the equations of single conditions, and exact solutions of one pair.

  /** Alart and Curnier's form of the normal condition, equation (2b): force_n = max(0, force_n - rho gap_n).
   *  Returns whether it is closed. */
  bool normal_condition(double force, double opening, double rho, PairEquations &equations);

  /** The same by Fischer and Burmeister: a + b = sqrt(a^2 + b^2). */
  void smooth_normal_condition(double force, double opening, double rho, PairEquations &equations);

  /** No slip: equations (5) and (6). */
  void no_slip(double slip_a, double slip_b, double rho, PairEquations &equations);

  /** Alart and Curnier's equations of Coulomb's law; @p slip: tangential displacement of the step. */
  void alart_curnier(const Vector3 &force, double opening, const std::array<double, 2> &slip, double friction,
                     double rho, PairEquations &equations);

  /** What a surface misses of Coulomb's law, the natural map of De Saxce: r - P(r - rho (u + mu |u_t| n)), P:
   *  projection on the cone of friction, u: opening and slip. */
  Vector3 natural_map(const Vector3 &force, const Vector3 &moved, double friction, double rho);

  /** Exact solution of Coulomb's law at one pair: gap = H force + b, gap_n >= 0, friction against the
   *  tangential gap. @p H symmetric positive definite. */
  Vector3 solve_coulomb(const Matrix3 &H, const Vector3 &b, double friction);

  /** Forces that make the marked components of H f + b zero; the other components carry none. */
  Vector3 tie_rows(Matrix3 H, Vector3 b, const std::array<bool, 3> &tied);
} // namespace Voussoir

#endif
