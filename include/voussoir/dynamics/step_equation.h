// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_step_equation_h
#define voussoir_step_equation_h

#include <voussoir/dynamics/dynamic_state.h>
#include <voussoir/joints/joint_system.h>

namespace Voussoir
{
  /** Length of a step, and loads at its end. The vectors must outlive the object. */
  struct StepLoad
  {
    double          dt;            ///< length of the step, full or reduced [s]
    const Unknowns &load;          ///< nodal loads at the end, three values per free node [N]
    const Vector3  &base_velocity; ///< velocity of the base at the end, see Integrator::advance() [m/s]
  };

  /** Returns the operator A of a step by the trapezoidal rule with damping.
   * @param structure damping: factors a_0 of the mass and a_1 of the stiffness, and mechanisms
   * @param dt length of the step [s]
   * @param share 2 if the joint forces are means over the step, 1 if they are forces at its end [-]
   *
   * The factors are 4/dt^2 + 2/dt a_0 for M, and 1 + Damping::more_stiffness() for K (1 + 2/dt a_1 without mechanisms;
   * with Damping::zones its second part for K_c). */
  StepOperator trapezoidal_rule(const Structure &structure, double dt, double share);

  /** Equation of a step by the trapezoidal rule: the sum of the equations of motion at both ends, in which the
   * accelerations cancel,
   *
   * A u_new = load + load_old + M (4/dt^2 u + 4/dt v) + 2/dt C u - K u + share G^T force,
   *
   * plus the damping by the motion of the base. With share = 2 force is the mean over the step. With share = 1
   * force is the force at its end, and G^T force_old is added.
   *
   * Order of the calls: start() once for the initial state. In each step solve(), then carry() if the joints
   * converge. Newmark updates the DynamicState itself. */
  class StepEquation
  {
  public:
    /** Stores the parameters.
     * @param structure masses, stiffness, damping and pairs; must outlive the object
     * @param share as in trapezoidal_rule() [-] */
    StepEquation(const Structure &structure, double share) : structure(structure), share(share) {}
    virtual ~StepEquation() = default;

    /** Joint data and unknowns of a step, see JointSystem::solve(). */
    struct Joints
    {
      const Unknowns &offset; ///< gap for zero displacement, three values per pair [m]
      const Unknowns &start;  ///< gap at the start: of now.u or Carried::gap, three values per pair [m]
      Unknowns       &memory; ///< history variables before the step; receives the events of the step
      Unknowns       &force;  ///< forces of the last step; receives those of this step, three per pair [N]
      Unknowns       &gap;    ///< receives the gaps at the end of the step, three values per pair [m]
      Unknowns       &u_new;  ///< receives the displacement at the end, three values per free node [m]
      BaseOfStep     &base;   ///< base nodes on a support; receives the forces of the support
    };

    /** Sets @p now.carried of the initial state. */
    virtual void start(DynamicState &now) const = 0;

    /** Solves the step with the joint system of its operator trapezoidal_rule().
     * @param system joint system for the length of the step and the share of this object
     * @param now state at the start of the step
     * @param step length and loads of the step
     * @param joints data and results; see JointSystem::solve()
     *
     * Returns convergence and costs. If ContactResult::converged is false, the results in @p joints are the
     * best iterate. */
    virtual ContactResult solve(JointSystem &system, const DynamicState &now, const StepLoad &step,
                                const Joints &joints) = 0;

    /** Stores in @p now.carried what the next step requires of the step of the last solve().
     * @param now state that is still that at the start of the step, except for its history variables and
     * carried.gap
     * @param dt length of the step [s]
     * @param u_new displacement at the end of the step, three values per free node [m]
     * @param Ku_new stiffness matrix times @p u_new [N] */
    virtual void carry(DynamicState &now, double dt, const Unknowns &u_new, const Unknowns &Ku_new) const = 0;

  protected:
    /** Returns load + load_old + M (c_m u + 4/dt v) + c_k K u, the damping by the motion of the base, and
     * G^T force_old for share = 1: three values per free node [N].
     * @param now state at the start of the step: load_old, u, v, force_old
     * @param step length and loads of the step
     * @param c_m factor of M u [1/s^2]
     * @param c_k factor of K u [-] */
    Unknowns known_forces(const DynamicState &now, const StepLoad &step, double c_m, double c_k) const;
    /** Adds share G^T force to @p nodal_force, three values per free node [N]. @p force: three values per
     * pair [N]. */
    void add_joint_forces(const Unknowns &force, Unknowns &nodal_force) const;

    const Structure &structure;
    const double     share;
  };

  /** Returns the equation of the steps of a structure; @p structure must outlive the result.
   * - @p single_factors false: the unknown is the displacement at the end of the step;
   * - @p single_factors true: the unknown is the increment to the displacement that the last step leads to, and
   *   the residual is carried to the next step. Errors of single-precision factors then do not accumulate. */
  std::unique_ptr<StepEquation> step_equation(const Structure &structure, double share, bool single_factors);
} // namespace Voussoir

#endif
