// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_law_h
#define voussoir_joint_law_h

#include <voussoir/base/tensor3.h>

namespace Voussoir
{
  /** Contact state of a pair. */
  enum class PairState : unsigned char
  {
    open,  ///< no contact force; a cracked bond may still carry tension
    stick, ///< closed or bonded, without slip
    slip   ///< closed, with slip at the friction limit
  };

  /** Equations of a pair and one element of their generalised Jacobian. The residual is zero if and only if
   * the conditions of the joint law are satisfied. */
  struct PairEquations
  {
    Vector3 residual; ///< residual [N]
    Matrix3 d_force;  ///< derivative of the residual by the force [-]
    Matrix3 d_gap;    ///< derivative of the residual by the gap [N/m]
    /** Contact state that the equations correspond to. Open pairs that are not tied have no velocity correction; for
     * slip see Impact. */
    PairState state;

    /** Active surfaces, which carry force: one bit per surface. Bit 0 is the face of the joint; a law defines
     * bits 1 to 7, such as the flanks of a key; with an adhesion bit 2 belongs to ElasticLaw. 0: the pair is open. */
    unsigned char active;
  };

  /** Event that changes the history variables of a pair. */
  enum class JointEvent
  {
    limit, ///< JointLaw::utilisation() exceeds 1
    cut    ///< the bond is lost immediately: a saw cut, a gap that grout did not fill, or a brittle crack
  };

  /** Data of a pair besides force and gap. A law has no velocity and no time step. */
  struct PairHistory
  {
    /** @param start gap at the start of the step [m] */
    PairHistory(const Vector3 &start = {}) : start(start) {}

    Vector3 start;           ///< gap at the start of the step [m]
    double  area = 1.;       ///< tributary area of the pair; force divided by area is a stress [m^2]
    bool    is_mean = false; ///< true: forces are means over the step; false: forces at its end

    /** JointLaw::n_memory() history variables of the pair: those at the start of the step, changed by the
     * events of this step. Unused if n_memory() is 0. Null in tests of laws with several surfaces. */
    const double *memory = nullptr;
  };

  class SurfacesLaw;
  class ElasticLaw;

  /** Conditions between the two faces of a joint at one pair, in the frame (n, a, b) of the pair.
   *
   * - n: from side 1 to side 2, normal to the joint; b: upwards in the joint (along +y in a nearly horizontal
   *   joint); a = b x n. See find_pairs() and Pair::frame.
   * - force: force of side 1 on side 2 [N]; force[0] > 0 is compression.
   * - gap: displacement of side 2 relative to side 1 since grouting [m]; gap[0] >= 0 is the opening.
   * - start: gap at the start of the step [m]. The slip of the step is the tangential part of gap - start.
   *   Friction acts against the slip: force_t = -mu force_n slip/|slip|.
   *
   * One constant object serves all pairs of a joint. Values that change are history variables, n_memory() per pair,
   * which the time integration stores, also for reduced time steps and checkpoints.
   *
   * Order of the calls in a time step (4: trapezoidal scheme only):
   * 1. solve(), in implicit steps also evaluate() and error(), until all pairs converge; explicit: evaluate() last;
   * 2. utilisation() for each pair. If a value exceeds 1, apply_event() for the pairs with the largest
   *    values, and the step is solved again from 1;
   * 3. commit() once for each pair;
   * 4. after commit(): solve_impulse() or stop_normal() for the velocity correction (Impact).
   *    They receive the history variables after 2, not those that commit() changed. */
  class JointLaw
  {
  public:
    virtual ~JointLaw() = default;

    /** Computes the equations of a pair and their derivatives.
     * @param force force at the end of the step, or its mean over the step (PairHistory::is_mean) [N]
     * @param gap gap at the end of the step [m]
     * @param history data of the pair
     * @param rho positive scaling factor, independent of the solution [N/m]
     * @param equations receives the result */
    virtual void evaluate(const Vector3 &force, const Vector3 &gap, const PairHistory &history, double rho,
                          PairEquations &equations) const = 0;

    /** Returns the error of a force and a gap [N], by which the solver measures convergence. The arguments are
     * those of evaluate(). The error is equal for all formulations of a law (Equations). For Coulomb's law it
     * is the natural map (De Saxce and Feng 1998). The default is the residual of evaluate(). */
    virtual Vector3 error(const Vector3 &force, const Vector3 &gap, const PairHistory &history,
                          double rho) const;

    /** Returns the force that satisfies the law of this pair exactly [N], for gap = H force + b and fixed
     * forces of the other pairs.
     * @param H flexibility of the pair [m/N], positive definite
     * @param b gap without the force [m]
     * @param history data of the pair */
    virtual Vector3 solve(const Matrix3 &H, const Vector3 &b, const PairHistory &history) const = 0;

    /** Returns the impulse that the law allows in an impact [N s]. The velocity of side 2 relative to side 1
     * after the impact is H impulse + v. Called for closed pairs, and with @p active 0 for open pairs if
     * is_tangentially_tied() is true. The impulse never adds energy, for any @p active.
     * @param H inverse mass of the pair [1/kg]
     * @param v velocity of side 2 relative to side 1 without the impulse [m/s]
     * @param history data of the pair
     * @param active active surfaces, see PairEquations::active */
    virtual Vector3 solve_impulse(const Matrix3 &H, const Vector3 &v, const PairHistory &history,
                                  unsigned char active) const = 0;

    /** Returns the total impulse of a step after a correction that never adds energy [N s]. The correction
     * removes only the velocity normal to the active surfaces. The velocity after the correction is
     * v + H (result - applied).
     * @param H inverse mass of the pair [1/kg]
     * @param v velocity of side 2 relative to side 1 at the end of the step, before the correction [m/s]
     * @param applied impulse of the joint force in the step, before the correction [N s]
     * @param active active surfaces, see PairEquations::active
     *
     * The default is for one flat face. It changes only the normal component of @p applied, to
     * max(applied[0] - v[0] / H[0], min(0, applied[0])). The normal velocity becomes zero, unless this
     * requires more tension than @p applied has. An open pair (@p active 0) keeps @p applied. */
    virtual Vector3 stop_normal(const Matrix3 &H, const Vector3 &v, const Vector3 &applied,
                                unsigned char active) const;

    /** Returns true if slip is zero for open and closed pairs. */
    virtual bool is_tangentially_tied() const { return false; }

    /** Returns the number of history variables of a pair. They are zero at first and after grouting. */
    virtual unsigned int n_memory() const { return 0; }

    /** Returns true if the law requires forces that are means over the step (ImpactRule::mean_force). */
    virtual bool needs_mean_force() const { return false; }

    /** Returns the utilisation of a pair, such as tensile stress over strength [-]. A converged solution with
     * a value above 1 is not accepted, see apply_event(). The default is 0.
     * @param force force of the solution [N]
     * @param gap gap of the solution [m]
     * @param history data of the pair */
    virtual double utilisation(const Vector3 &force, const Vector3 &gap, const PairHistory &history) const;

    /** Stores an event of the step, such as a crack or the contact of a key flank. The solver then solves the
     * step again with the new history variables, and begins with a zero force of the pair. The event follows
     * from the history variables alone. The default does nothing.
     * @param memory n_memory() history variables of the pair, which the event changes
     * @param event reason of the event */
    virtual void apply_event(double *memory, JointEvent event = JointEvent::limit) const;

    /** Updates the history variables after a step is accepted. The default does nothing.
     * @param force force of the accepted solution [N]
     * @param gap gap of the accepted solution [m]
     * @param history data of the pair
     * @param memory history variables, changed in place. history.memory points to the same array: read the old
     * values before you write. */
    virtual void commit(const Vector3 &force, const Vector3 &gap, const PairHistory &history,
                        double *memory) const;

    /** Returns the energy of a pair [J]: the energy that the bond stores and has dissipated, or the energy
     * stored by the contact compliance of key flanks. It counts only if the law has history variables, see
     * PairLaws::joint_energy(). The default is 0.
     * @param gap gap at one time [m]
     * @param area tributary area of the pair [m^2]
     * @param memory history variables at the same time */
    virtual double bond_energy(const Vector3 &gap, double area, const double *memory) const;

    /** Returns this object if a pair has several contact surfaces with separate forces, else a null pointer.
     * The solver uses these forces as unknowns, see PairSurfaces. */
    virtual const SurfacesLaw *surfaces_law() const { return nullptr; }

    /** Returns the compliance of the elastic flanks of keys [m/Pa]; 0: rigid or none. */
    virtual double flank_compliance() const { return 0.; }

    /** Returns this object if the joint itself is elastic or has an adhesion, else a null pointer. */
    virtual const ElasticLaw *elastic_law() const { return nullptr; }

    /** Returns the coefficient of friction [-] if the law is Coulomb's law with constant friction on one flat
     * face, else -1. */
    virtual double flat_friction() const { return -1.; }
  };
} // namespace Voussoir

#endif
