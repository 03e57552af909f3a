// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_integrator_h
#define voussoir_integrator_h

#include <voussoir/dynamics/dynamic_state.h>
#include <voussoir/joints/joint_system.h>

namespace Voussoir
{
  /** Time integration of a structure with joints: M a + C v + K u = load + G^T force. Has the state and the
   * energies; the scheme of a derived class advances them. Structure and laws must outlive the object. */
  class Integrator
  {
  public:
    // Nodes are the free nodes of the structure. Values per node have the components x, y, z, values per pair
    // the components (n, a, b) of Pair::frame. All ranks call start(), resume() and advance().

    Integrator(const Structure &structure, const JointLaws &laws) : structure(structure), laws(laws) {}
    Integrator(const Integrator &) = delete;
    virtual ~Integrator() = default;

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
    virtual void start(const Unknowns &u, const Unknowns &v, const Unknowns &force, const Unknowns &load,
                       const Unknowns &reference, const Unknowns &memory = {},
                       const Unknowns &elastic_force = {});

    /** Restores a saved state; start() is required only with an elastic force.
     * @param state state at the time of the checkpoint
     * @param first energies at the start of the run
     * @param largest_energy value of largest_energy() at the time of the checkpoint [J]
     * @param reference as in start()
     *
     * Throws InputError if @p state has another number of history variables than the laws. */
    virtual void resume(const DynamicState &state, const Energy &first, double largest_energy,
                        const Unknowns &reference);

    /** Advances the state by one step: all members of DynamicState (carried as the scheme needs it) with all terms of
     * Energy, #impulse, and update_largest(). A new member of the state belongs to serialize() in output/archive.h.
     * @param load nodal loads at the end of the step, three values per node [N]
     * @param base_velocity velocity x, y, z of the base at the end of the step [m/s]: absolute, or zero if
     * displacements are relative to the base. Mass-proportional damping acts on the velocity relative to it.
     *
     * Throws ComputationError if the joints do not converge, or if displacements are not finite. The state is then
     * that of the last accepted step, with Leapfrog of the failed step h. Returns convergence and costs of contact. */
    virtual ContactResult advance(const Unknowns &load, const Vector3 &base_velocity = {{0., 0., 0.}}) = 0;

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

    /** Returns the impulses of the joint forces on side 2 in the last step, after the velocity correction,
     * three values per pair [N s]. Zero before the first step. */
    const Unknowns &impulses() const { return impulse; }

    /** Returns the contact states of the pairs in the last step. Before the first step of this object, all
     * pairs are open. */
    virtual const std::vector<PairState> &pair_states() const = 0;

    virtual SystemTimes times() const = 0; ///< times of all steps of this object

    /** Weight of the load at the end in the mean load of a time step [-]; the rest is that at its start. */
    virtual double weight_of_end() const { return .5; }

    virtual double memory() const = 0; ///< memory consumption of factors and operators [bytes]

  protected:
    void        account_states();     ///< sets the kinetic and the strain energies of the state
    JointEnergy joint_energy() const; ///< energies of the laws in the state
    void        update_largest();     ///< raises largest_energy() to the current energies

    const Structure &structure;
    const JointLaws &laws;
    Unknowns         reference; ///< see start() [m]
    Unknowns         impulse;   ///< see impulses() [N s]
    DynamicState     now;
    Unknowns         elastic_force;       ///< constant part of the loads, see start() [N]
    double           elastic_energy = 0.; ///< half of its product with the initial displacement [J]
    Energy           first;               ///< energies at the start [J]
    double           largest = 0.;        ///< see largest_energy() [J]
  };
} // namespace Voussoir

#endif
