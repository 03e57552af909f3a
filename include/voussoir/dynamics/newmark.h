// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_newmark_h
#define voussoir_newmark_h

#include <voussoir/dynamics/impact.h>
#include <voussoir/dynamics/step_equation.h>
#include <voussoir/dynamics/support.h>

namespace Voussoir
{
  /** Time integration of a structure with joints by the trapezoidal rule: M a + C v + K u = load + G^T force,
   * with Rayleigh damping C.
   *
   * Each step has two stages: JointSystem computes the displacements and joint forces that satisfy the joint
   * laws, then Impact corrects the velocities of closed pairs. See doc/method.md. The structure, the laws and
   * the support must outlive the object. */
  class Newmark
  {
  public:
    // Nodes are the free nodes of the structure. Values per node have the components x, y, z, values per pair
    // the components (n, a, b) of Pair::frame. All ranks call start(), resume() and advance().

    /** Condenses the bodies for time steps of length @p dt. start() or resume() must follow.
     * @param structure masses, stiffness matrices, damping and pairs
     * @param laws joint laws of the pairs; structure and laws must outlive this object
     * @param parameters parameters of the contact solver
     * @param dt time step [s]
     * @param rule velocity correction of closed pairs
     * @param support subcycled or massless foundation, or nullptr. Its displacement must equal that of the
     * base nodes at start(). A step is not divided below one substep of the support.
     * @param single_factors stores the factors in single precision, which halves the memory traffic of a
     * step. The unknown of the step is then an increment, see StepEquation. Ignored with a @p support.
     *
     * Throws InputError if @p rule is not ImpactRule::mean_force but a law or the support requires it, or if
     * a node belongs to two pairs. Throws ComputationError if a body cannot be factorised. */
    Newmark(const Structure &structure, const JointLaws &laws, const ContactParameters &parameters, double dt,
            ImpactRule rule, Support *support = nullptr, bool single_factors = false);

    /** Sets the initial state at time 0. The velocity of the base is zero.
     * @param u displacement, three values per node [m]
     * @param v velocity, three values per node [m/s]
     * @param force joint forces of this state, on side 2, three values per pair [N]
     * @param load nodal loads of this state, three values per node [N]
     * @param reference displacement jump of each pair at which the joint is closed and without slip, three
     * values per pair [m]
     * @param memory history variables of the pairs; empty: initial values
     * @param elastic_force constant part of all loads that is an elastic force, three values per node [N];
     * empty: none. Its work counts as strain energy and not as input. The initial strain energy is
     * u (K u - elastic_force)/2. */
    void start(const Unknowns &u, const Unknowns &v, const Unknowns &force, const Unknowns &load,
               const Unknowns &reference, const Unknowns &memory = {}, const Unknowns &elastic_force = {});

    /** Restores a saved state; start() is required only with an elastic force.
     * @param state state at the time of the checkpoint
     * @param first energies at the start of the run
     * @param largest_energy value of largest_energy() at the time of the checkpoint [J]
     * @param reference as in start()
     *
     * Throws InputError if @p state has another number of history variables than the laws. */
    void resume(const DynamicState &state, const Energy &first, double largest_energy,
                const Unknowns &reference);

    /** Advances the state by one step to time + dt.
     * @param load nodal loads at the end of the step, three values per node [N]
     * @param base_velocity velocity x, y, z of the base at the end of the step [m/s]: absolute, or zero if
     * displacements are relative to the base. Mass-proportional damping acts on the velocity relative to it.
     *
     * If the joints do not converge, two reduced steps of dt/2 replace the step, and so on down to dt/8. Throws
     * ComputationError if the smallest steps do not converge, or if displacements are not finite. After a
     * failure to converge, the state is that at the end of the last accepted step, full or reduced.
     *
     * Returns convergence and costs of the contact problems, with those of reduced steps and failed attempts.
     */
    ContactResult advance(const Unknowns &load, const Vector3 &base_velocity = {{0., 0., 0.}});

    const DynamicState &state() const { return now; }            ///< current state; advance() changes it
    const Energy       &initial_energy() const { return first; } ///< energies at the start of the run

    /** Returns the maximum over time of the input, the kinetic energy, the change of strain energy and the
     * damping [J]. */
    double largest_energy() const { return largest; }

    /** Returns |balance| divided by largest_energy(), or by 1e-6 of the initial strain energy if this is
     * larger [-]. */
    double energy_error() const;

    /** Returns the current opening (n > 0: open) and slip (a, b) of a pair [m]: the displacement of side 2
     * relative to side 1, minus the reference of start(). */
    Vector3 opening_and_slip(unsigned int pair) const;

    /** Returns the contact states of the pairs in the last accepted step, full or reduced. Before the first
     * step of this object, all pairs are open. */
    const std::vector<PairState> &pair_states() const { return levels[last_level]->system.states(); }

    /** Returns the impulses of the joint forces on side 2 in the last step, after the velocity correction,
     * three values per pair [N s]. Those of reduced steps are added. Zero before the first step. */
    const Unknowns &impulses() const { return impulse; }

    /** Returns the joint system of the full time step. */
    const JointSystem &joint_system() const { return levels[0]->system; }

    /** Returns the memory consumption of the factors and joint operators of all step sizes [bytes]. */
    double memory() const;

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
    JointEnergy   joint_energy() const;
    void          account_states();

    const Structure              &structure;
    const JointLaws              &laws;
    const ContactParameters       parameters;
    const ImpactRule              rule;
    Support *const                support;
    const bool                    single_factors;
    const double                  share;          ///< StepOperator::share of the rule
    std::vector<unsigned int>     nodes_in_pairs; ///< each once
    Impact                        impact;
    std::unique_ptr<StepEquation> equation;
    Unknowns                      reference, impulse, gap;
    Unknowns     step_start, step_memory; ///< gaps [m] and history variables at the start of the last step
    DynamicState now;
    Unknowns     elastic_force;       ///< constant part of the loads, see start() [N]
    double       elastic_energy = 0.; ///< half of its product with the initial displacement [J]
    Energy       first;               ///< energies at the start
    double       largest = 0.;
    double       of_friction = 0.;              ///< PairLaws::friction_correction() of the last step [J]
    std::vector<std::unique_ptr<Level>> levels; ///< one per step size, created on demand
    unsigned int                        last_level = 0; ///< level of the last accepted step
  };
} // namespace Voussoir

#endif
