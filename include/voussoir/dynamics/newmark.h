// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_newmark_h
#define voussoir_newmark_h

#include <voussoir/dynamics/impact.h>
#include <voussoir/dynamics/support.h>

namespace Voussoir
{
  /** Energies [J] since the start; those above the line are states, those below accumulate. */
  struct Energy
  {
    double kinetic = 0., added_mass = 0., strain = 0.;           // of concrete; of water; of concrete
    double damping = 0., friction = 0., impact = 0., input = 0.; // input: work of all loads
    double joint_stored = 0.;                                    ///< that the seats of keys hold now
    double joint_fracture = 0.; ///< of bonds (law cohesive): held now, and lost so far

    /** What the account misses: zero but for round-off in a correct run. */
    double balance(const Energy &start) const;
  };

  /** What a step with factors in single precision hands on to the next one; 3 per node, else empty. */
  struct Carried
  {
    Unknowns left;     ///< impulse that it owes [N s]
    Unknowns moved;    ///< its displacement, to which the next one is an increment [m]
    Unknowns resisted; ///< what its operator made of that [N]
    double   dt = 0.;  ///< its length [s]
  };

  /** Displacement and velocity, and joint forces, at one time; on a rigid base relative to it. */
  struct DynamicState
  {
    double   time = 0.;
    Unknowns u, v;   ///< [m], [m/s], 3 per node
    Unknowns force;  ///< [N], 3 per pair, in the frame of the pair: mean over the last step, or at its end
    Unknowns load;   ///< [N], that of this time
    Unknowns Ku;     ///< stiffness times displacement [N]
    Unknowns memory; ///< of the joint laws: JointLaws::initial_memory() at first
    Carried  carried;
    Vector3  base_velocity = {{0., 0., 0.}}; ///< see Newmark::advance() [m/s]
    Energy   energy;
  };

  /** Trapezoidal Newmark with joints: M a + C v + K u = load + G^T force.
   *
   *  The displacements of a step satisfy the joint laws; then impact and release make velocity and
   *  acceleration fit (Impact). */
  class Newmark
  {
  public:
    /** @p support: what the dam's feet stand on if that makes steps of its own, or null; it must outlive
     * this. Steps are halved down to one of its own then, at most three times, and it is to be where the dam
     * is at the start. @p single_factors: in single precision, which halves what a step reads, without a
     * support; a step's displacement is then found as an increment to that of the step before, and what the
     * equations of motion leave over is carried to the next one. InputError for laws, and a support, that
     * need the rule mean-force without it. */
    Newmark(const Structure &structure, const JointLaws &laws, const ContactParameters &parameters, double dt,
            ImpactRule rule, Support *support = nullptr, bool single_factors = false);

    /** Start from displacement @p u and velocity @p v with the joint forces @p force of that state under @p
     * load; @p reference: jump of each pair, 3 per pair, at which it is closed and
     * unslipped [m]; @p memory: of the joint laws, nothing has happened yet if empty. */
    void start(const Unknowns &u, const Unknowns &v, const Unknowns &force, const Unknowns &load,
               const Unknowns &reference, const Unknowns &memory = {});

    /** Go on from a saved state, with the energies of the start and the largest one so far. */
    void resume(const DynamicState &state, const Energy &first, double largest_energy,
                const Unknowns &reference);

    /** One step to time + dt, under @p load there. When the joints do not converge, two steps of half the
     *  size take its place, and so on down to dt/8; then throws ComputationError, in a state between two
     *  steps. @p base_velocity: at that time, where the displacements are absolute: the mass-proportional
     *  damping acts on the velocity relative to it, as on a rigid base [m/s]. */
    ContactResult advance(const Unknowns &load, const Vector3 &base_velocity = {{0., 0., 0.}});

    const DynamicState &state() const { return now; }
    const Energy       &initial_energy() const { return first; }
    double              largest_energy() const { return largest; } ///< that has gone through [J]
    double              energy_error() const; ///< |balance| / largest energy that has gone through

    /** Opening and slip of a pair since @p reference, (n,a,b) [m]. */
    Vector3 opening_and_slip(unsigned int pair) const;

    /** Of the last step. */
    const std::vector<PairState> &pair_states() const { return levels[last_level]->system.states(); }
    const Unknowns               &impulses() const { return impulse; } ///< of the last step, 3 per pair [N s]
    const JointSystem            &joint_system() const { return levels[0]->system; } ///< of whole steps
    double memory() const; ///< of factors and joint operators, those of halved steps included [bytes]

  private:
    struct Work ///< of one step [J]
    {
      double opening = 0., friction = 0., input = 0., damping = 0.;
    };
    /** What belongs to the size of a step: whole, or halved once, twice, three times. All else is shared. */
    struct Level
    {
      double       dt;
      unsigned int n_substeps; ///< of the support
      JointSystem  system;
    };
    /** A step, or a part of it: the support's steps cannot be halved, so halves may differ by one of them. */
    struct Part
    {
      double       dt;
      unsigned int n_substeps, halvings;
    };
    void          add_level(const Part &part);
    unsigned int  level_of(const Part &part);
    ContactResult advance(const Part &part, const Unknowns &load, const Vector3 &base_velocity);
    ContactResult advance_in_halves(const Part &part, const Unknowns &load, const Vector3 &base_velocity,
                                    const ContactResult &failed);
    bool step(Level &level, const Unknowns &load, const Vector3 &base_velocity, ContactResult &result);
    ContactResult solve(Level &level, const Unknowns &load, const Vector3 &base_velocity, Unknowns &force,
                        Unknowns &u_new, Unknowns &left, FeetOfStep &feet);
    Unknowns      at_feet(const Unknowns &u) const;
    double        push_support(const Level &level, FeetOfStep &feet, const Unknowns &u_new);
    void          add_work_of_joints(double dt, const Unknowns &u_new, Unknowns &change, Work &work) const;
    bool          continues(double dt, const Unknowns &forces) const;
    void          add_joint_forces(const Unknowns &force, Unknowns &nodal_force) const;
    ContactResult solve_for_increment(Level &level, const Unknowns &start, Unknowns &memory, Unknowns &force,
                                      Unknowns &u_new, Unknowns &left);
    void          move(double dt, const Unknowns &load, const Vector3 &base_velocity, const Unknowns &u_new,
                       const Unknowns &left, Work &work);
    void          account(const Work &work, double kinetic_before);
    Unknowns      right_hand_side(double dt, const Unknowns &load, const Vector3 &base_velocity) const;
    Unknowns      force_without_joints() const;
    double        kinetic_energy_of_pairs() const;
    JointEnergy   joint_energy() const;
    void          account_states();

    const Structure        &structure;
    const JointLaws        &laws;
    const ContactParameters parameters;
    const ImpactRule        rule;
    Support *const          support;
    const bool              is_single; ///< are the factors in single precision?
    Impact                  impact;
    Unknowns                reference, impulse, gap;
    Unknowns                step_start, step_memory; ///< of the pairs, in the equations of the last step [m]
    DynamicState            now;
    Energy                  first; ///< at the start
    double                  largest = 0.;
    double                  of_friction = 0.;           ///< JointSystem::friction_correction()
    std::vector<std::unique_ptr<Level>> levels;         ///< by number of halvings; made when they are needed
    unsigned int                        last_level = 0; ///< of the last step, or its last part
  };
} // namespace Voussoir

#endif
