// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_step_equation_h
#define voussoir_step_equation_h

#include <voussoir/dynamics/dynamic_state.h>
#include <voussoir/joints/joint_system.h>

namespace Voussoir
{
  /** Length of a step, and loads at its end. */
  struct StepLoad
  {
    double          dt;            ///< [s]
    const Unknowns &load;          ///< nodal loads [N]
    const Vector3  &base_velocity; ///< velocity of the base if displacements are absolute [m/s]
  };

  /** Returns the operator of a step of length @p dt by the trapezoidal rule with Rayleigh damping. @p share:
   * 2 if the joint forces are means over the step, 1 if they are forces at its end. */
  StepOperator trapezoidal_rule(const Structure &structure, double dt, double share);

  /** Equation of a step by the trapezoidal rule: the sum of the equations of motion at both ends, in which the
   * accelerations cancel,
   *
   * A u_new = load + load_old + M (4/dt^2 u + 4/dt v) + 2/dt C u - K u + share G^T force,
   *
   * plus the damping by the motion of the base. With share = 2 force is the mean over the step. With share = 1
   * force is the force at its end, and G^T force_old is added.
   *
   * Each step calls solve(), and carry() if the joints converge. */
  class StepEquation
  {
  public:
    StepEquation(const Structure &structure, double share) : structure(structure), share(share) {}
    virtual ~StepEquation() = default;

    /** Joint data and unknowns of a step, see JointSystem::solve(). */
    struct Joints
    {
      const Unknowns &offset, &start;
      Unknowns       &memory, &force, &gap, &u_new;
      BaseOfStep     &base;
    };

    /** Prepares the initial state @p now. */
    virtual void start(DynamicState &now) const = 0;

    /** Solves the step with the joint system of its operator. */
    virtual ContactResult solve(JointSystem &system, const DynamicState &now, const StepLoad &step,
                                const Joints &joints) = 0;

    /** Stores in @p now.carried what the next step requires of this step of length @p dt from now.u to
     * @p u_new. @p Ku_new: stiffness matrix times u_new [N]. */
    virtual void carry(DynamicState &now, double dt, const Unknowns &u_new, const Unknowns &Ku_new) const = 0;

  protected:
    /** Returns load + load_old + M (c_m u + 4/dt v) + c_k K u, the damping by the motion of the base, and
     * G^T force_old for share = 1 [N]. */
    Unknowns known_forces(const DynamicState &now, const StepLoad &step, double c_m, double c_k) const;
    /** Adds share G^T force to @p nodal_force. */
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
