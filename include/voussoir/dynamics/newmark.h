// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_newmark_h
#define voussoir_newmark_h

#include <voussoir/dynamics/impact.h>
#include <voussoir/dynamics/integrator.h>
#include <voussoir/dynamics/step_equation.h>
#include <voussoir/dynamics/support.h>

namespace Voussoir
{
  /** Time integration of a structure with joints by the trapezoidal rule: M a + C v + K u = load + G^T force,
   * with Rayleigh or uniform damping C.
   *
   * Each step has two stages: JointSystem computes the displacements and joint forces that satisfy the joint
   * laws, then Impact corrects the velocities of closed pairs. See doc/method.md. The support must outlive the
   * object. */
  class Newmark : public Integrator
  {
  public:
    /** Condenses the bodies for time steps of length @p dt. start() or resume() must follow.
     * @param structure masses, stiffness matrices, damping and pairs
     * @param laws joint laws of the pairs
     * @param parameters parameters of the contact solver
     * @param dt time step [s]
     * @param rule velocity correction of closed pairs
     * @param support subcycled or massless foundation, or nullptr. Its displacement must equal that of the
     * base nodes at start(). A step is not divided below one substep of the support.
     * @param single_factors stores the factors in single precision, which halves the memory traffic of a
     * step. The unknown of the step is then an increment, see StepEquation. Ignored with a @p support.
     *
     * Throws InputError if @p rule is not ImpactRule::mean_force but a law or the support requires it, or if
     * pairs share nodes and the rule is paper. Throws ComputationError if a body cannot be factorised. */
    Newmark(const Structure &structure, const JointLaws &laws, const ContactParameters &parameters, double dt,
            ImpactRule rule, Support *support = nullptr, bool single_factors = false);

    void start(const Unknowns &u, const Unknowns &v, const Unknowns &force, const Unknowns &load,
               const Unknowns &reference, const Unknowns &memory = {},
               const Unknowns &elastic_force = {}) override;

    /** Advances the state by one step to time + dt.
     *
     * If the joints do not converge, two reduced steps of dt/2 replace the step, and so on down to dt/8. Throws
     * ComputationError if the smallest steps do not converge. The result includes reduced steps and failed
     * attempts; impulses() adds those of reduced steps. */
    ContactResult advance(const Unknowns &load, const Vector3 &base_velocity = {{0., 0., 0.}}) override;

    const std::vector<PairState> &pair_states() const override { return levels[last_level]->system.states(); }
    SystemTimes                   times() const override { return levels[0]->system.times; }
    double                        memory() const override;

    /** Returns the joint system of the full time step. */
    const JointSystem &joint_system() const { return levels[0]->system; }

  private:
    struct Work ///< works of one step [J]
    {
      double opening = 0., friction = 0., input = 0., damping = 0.;
    };
    /** Operators for one step size: full, or halved once, twice or three times. */
    struct Level
    {
      double       dt;         ///< [s]
      unsigned int n_substeps; ///< substeps of the support
      JointSystem  system;
    };
    /** Size of a full or reduced step. Two halves may differ by one substep of the support, because substeps
     * are not divided. */
    struct StepSize
    {
      double       dt;
      unsigned int n_substeps, halvings;
    };
    void          add_level(const StepSize &size);
    unsigned int  level_of(const StepSize &size);
    ContactResult advance(const StepSize &size, const Unknowns &load, const Vector3 &base_velocity);
    ContactResult advance_in_halves(const StepSize &size, const Unknowns &load, const Vector3 &base_velocity,
                                    const ContactResult &failed);
    bool          step(Level &level, const StepLoad &step, ContactResult &result);
    ContactResult solve(Level &level, const StepLoad &step, Unknowns &force, Unknowns &u_new,
                        BaseOfStep &base);
    Unknowns      at_base(const Unknowns &u) const;
    double        advance_support(const Level &level, const BaseOfStep &base, const Unknowns &u_new);
    void          add_work_of_joints(double dt, const Unknowns &u_new, Unknowns &change, Work &work) const;
    void          move(const StepLoad &step, const Unknowns &u_new, Work &work);
    void          account(const Work &work, double kinetic_before);
    Unknowns      force_without_joints() const;
    double        kinetic_energy_of_pairs() const;

    const ContactParameters       parameters;
    const ImpactRule              rule;
    Support *const                support;
    const bool                    single_factors;
    const double                  share;          ///< StepOperator::share of the rule
    std::vector<unsigned int>     nodes_in_pairs; ///< each once
    Impact                        impact;
    std::unique_ptr<StepEquation> equation;
    Unknowns                      gap;
    Unknowns step_start, step_memory; ///< gaps [m] and history variables at the start of the last step
    double   of_friction = 0.;        ///< PairLaws::friction_correction() of the last step [J]
    std::vector<std::unique_ptr<Level>> levels;         ///< one per step size, created on demand
    unsigned int                        last_level = 0; ///< level of the last accepted step
  };
} // namespace Voussoir

#endif
