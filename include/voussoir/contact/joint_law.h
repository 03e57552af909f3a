// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_law_h
#define voussoir_joint_law_h

#include <voussoir/base/tensor3.h>

namespace Voussoir
{
  /** Contact state of a pair. */
  enum class PairState : unsigned char
  {
    open,
    stick,
    slip
  };

  /** Equations of a pair and one element of their generalised Jacobian. The residual is zero if and only if
   * the conditions of the joint law are satisfied. */
  struct PairEquations
  {
    Vector3   residual; ///< residual [N]
    Matrix3   d_force;  ///< derivative of the residual by the force [-]
    Matrix3   d_gap;    ///< derivative of the residual by the gap [N/m]
    PairState state;    ///< contact state that the equations correspond to
    unsigned char
        touching; ///< active surfaces, one bit per surface, bit 0: the face; 0 if no surface carries force
  };

  /** Data of a pair that a joint law requires besides force and gap. */
  struct PairHistory
  {
    PairHistory(const Vector3 &start = {}) : start(start) {}

    Vector3 start; ///< gap at the start of the step [m]

    double area = 1.;       ///< tributary area: force over stress [m^2]
    bool   is_mean = false; ///< true: forces are means over the step; false: forces at its end

    /** JointLaw::n_memory() history variables of the pair: those at the start of the step, changed by the
     * events of this step. Null if the law has none. */
    const double *memory = nullptr;
  };

  class SurfacesLaw;

  /** Conditions between the two faces of a joint at one pair, in the frame (n, a, b) of the pair.
   *
   * - force: force of side 1 on side 2 [N]; force[0] > 0 is compression.
   * - gap: displacement of side 2 relative to side 1 since grouting [m]; gap[0] >= 0 is the opening.
   * - start: gap at the start of the step [m]. The slip of the step is the tangential part of gap - start.
   *   Friction acts against it: force_t = -mu force_n slip/|slip|. (The paper's P_tau has the opposite sign.)
   *
   * One constant object serves all pairs of a joint. Values that change are history variables, n_memory() per
   * pair. They are part of the state of the time integration, as for reduced time steps and checkpoints.
   * commit() updates them when a step is accepted.
   *
   * For each time step the solver calls evaluate(), error() and solve() until the pairs converge. Then it
   * calls utilisation(), and apply_event() at pairs that fail; in that case the step is solved again. Finally commit()
   * is called once per pair. */
  class JointLaw
  {
  public:
    virtual ~JointLaw() = default;

    /** Computes the equations of a pair and their derivatives.
     * @param force force at the end of the step, or its mean [N]
     * @param gap gap at the end of the step [m]
     * @param history data of the pair
     * @param rho positive scaling factor [N/m]; the solution does not depend on it
     * @param equations receives the result */
    virtual void evaluate(const Vector3 &force, const Vector3 &gap, const PairHistory &history, double rho,
                          PairEquations &equations) const = 0;

    /** Returns the error of a force and a gap [N], by which the solver measures convergence. It does not
     * depend on the formulation of the law. For Coulomb's law it is the natural map (De Saxce and Feng 1998).
     * The default is the residual of evaluate(). */
    virtual Vector3 error(const Vector3 &force, const Vector3 &gap, const PairHistory &history,
                          double rho) const;

    /** Returns the exact force of a pair alone [N], for gap = H force + b.
     * @param H flexibility of the pair [m/N], positive definite
     * @param b gap without the force [m]
     * @param history data of the pair */
    virtual Vector3 solve(const Matrix3 &H, const Vector3 &b, const PairHistory &history) const = 0;

    /** Returns the impulse that the law allows in an impact [N s]. The velocity after the impact is H
     * impulse + v.
     * @param H inverse mass of the pair [1/kg]
     * @param v relative velocity without the impulse [m/s]
     * @param history data of the pair, as in evaluate()
     * @param touching active surfaces, see PairEquations */
    virtual Vector3 solve_impulse(const Matrix3 &H, const Vector3 &v, const PairHistory &history,
                                  unsigned char touching) const = 0;

    /** Returns the impulse of a step after a correction that never adds energy [N s]. The correction removes
     * only the velocity normal to the active surfaces.
     * @param H inverse mass of the pair [1/kg]
     * @param v relative velocity at the end of the step [m/s]
     * @param spent impulse of the step so far [N s]
     * @param touching active surfaces, see PairEquations */
    virtual Vector3 stop_normal(const Matrix3 &H, const Vector3 &v, const Vector3 &spent,
                                unsigned char touching) const;

    /** Returns the contact force for given accelerations [N].
     * @param H inverse mass of the pair [1/kg]
     * @param b relative acceleration without the force [m/s^2]
     * @param slip_velocity velocity of side 2 relative to side 1 [m/s]
     * @param still speed up to which a pair does not slip [m/s]
     * @param history data of the pair
     * @param touching active surfaces, see PairEquations */
    virtual Vector3 solve_acceleration(const Matrix3 &H, const Vector3 &b, const Vector3 &slip_velocity,
                                       double still, const PairHistory &history,
                                       unsigned char touching) const;

    /** Returns whether slip is zero for open and closed pairs. */
    virtual bool is_tangentially_tied() const { return false; }

    /** Returns the number of history variables of a pair. Their initial values are zero. */
    virtual unsigned int n_memory() const { return 0; }

    /** Returns whether the law requires forces that are means over the step (impact rule mean-force). */
    virtual bool needs_mean_force() const { return false; }

    /** Returns the utilisation of a pair for a force and a gap, such as tensile stress over strength [-]. A
     * converged solution with values above 1 is not accepted: the pairs with the largest values get an event,
     * see apply_event(), and the step is solved again. */
    virtual double utilisation(const Vector3 &, const Vector3 &, const PairHistory &) const { return 0.; }

    /** Stores an event of the step (a crack, a key that meets its flank) in the history variables. */
    virtual void apply_event(double *) const {}

    /** Updates the history variables after a step is accepted with this force and gap. The last argument
     * points to the same values as history.memory. */
    virtual void commit(const Vector3 &, const Vector3 &, const PairHistory &, double *) const {}

    /** Returns the energy of a pair for a gap, the tributary area [m^2] and the history variables at the same
     * time [J]. It is the energy that the bond stores and has dissipated, or the energy stored by the contact
     * compliance of key flanks. */
    virtual double bond_energy(const Vector3 &, double, const double *) const { return 0.; }

    /** Returns this object if its pairs touch on several surfaces with separate forces, else a null pointer.
     * The solver then uses these forces as unknowns, see PairSurfaces. */
    virtual const SurfacesLaw *surfaces_law() const { return nullptr; }

    /** Returns the coefficient of friction if the law is Coulomb's law on one flat face, else -1. */
    virtual double flat_friction() const { return -1.; }
  };
} // namespace Voussoir

#endif
