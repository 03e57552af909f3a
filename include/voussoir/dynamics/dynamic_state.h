// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_dynamic_state_h
#define voussoir_dynamic_state_h

#include <voussoir/solid/damping.h>

namespace Voussoir
{
  /** Terms of the energy balance [J]. The kinetic energies and the strain energy are current values. The
   * joint energies are those of PairLaws::joint_energy(). The other terms are works since Integrator::start(). */
  struct Energy
  {
    double kinetic = 0.;    ///< kinetic energy of the concrete
    double added_mass = 0.; ///< kinetic energy of the added mass of the water
    double strain = 0.;     ///< strain energy of the concrete, with that of the mechanisms of Damping
    double damping = 0.;    ///< dissipation by damping
    double friction = 0.;   ///< dissipation by friction on faces and flanks of the joints
    double impact = 0.;     ///< remaining work in the joints: loss by impacts
    double input = 0.;      ///< work of all loads and of the support

    /** Energy stored by flank contacts of shear keys (KSM) and elastic joints (ElasticLaw). */
    double joint_stored = 0.;

    /** Energy stored and dissipated by all other joint laws with history variables: bonds (cohesive). */
    double joint_fracture = 0.;

    /** Returns the error of the energy balance with respect to the state @p start [J]. It is zero up to
     * the error of the factors in a correct run. */
    double balance(const Energy &start) const;
  };

  /** Data passed from one step to the next if the unknown is an increment (StepEquation). The vectors have
   * three values per node unless stated otherwise; they are empty if the unknown is the displacement. */
  struct Carried
  {
    Unknowns residual; ///< residual impulse: dt/2 times the residual of the equation of motion [N s]
    Unknowns moved;    ///< displacement increment of the last step [m]
    Unknowns resisted; ///< operator of the step applied to moved [N]
    double   dt = 0.;  ///< length of the last step [s]; 0: there was none

    /** Set by Newmark: openings and slips in the solution of the joints of the last step, three values per pair [m].
     * The contact conditions hold more exactly for these values than for the displacements. Empty before the first
     * step. */
    Unknowns gap;
  };

  /** State of the structure at one time. Displacements are relative to the base on a rigid or massless
   * foundation, and absolute on explicit rock. */
  struct DynamicState
  {
    double   time = 0.; ///< [s]
    Unknowns u, v;      ///< displacement [m] and velocity [m/s], three values per node
    /** Joint forces, three values per pair in the frame of the pair [N]. With ImpactRule::mean_force they are
     * means over the last step, otherwise values at this time. */
    Unknowns      force;
    Unknowns      load;       ///< nodal loads at this time [N]
    Unknowns      Ku;         ///< stiffness matrix times u [N]
    Unknowns      memory;     ///< history variables of all pairs; at first JointLaws::initial_memory()
    Carried       carried;    ///< see StepEquation
    DampingMemory relaxation; ///< of the concrete; empty without mechanisms of Damping
    Vector3       base_velocity = {{0., 0., 0.}}; ///< velocity of the base, see Integrator::advance() [m/s]
    Energy        energy;
  };
} // namespace Voussoir

#endif
