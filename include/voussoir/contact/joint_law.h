// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_law_h
#define voussoir_joint_law_h

#include <voussoir/base/tensor3.h>

namespace Voussoir
{
  enum class PairState : unsigned char
  {
    open,
    stick,
    slip
  };

  /** The equations of a pair, zero exactly when its conditions hold, with one element of the generalized
   * Jacobian. */
  struct PairEquations
  {
    Vector3   residual; ///< [N]
    Matrix3   d_force;  ///< d residual / d force [-]
    Matrix3   d_gap;    ///< d residual / d gap [N/m]
    PairState state;    ///< that the equations stand for
    unsigned char
        touching; ///< surfaces of the law that touch, one bit each, if any carries force; bit 0: the face
  };

  /** What a law knows of its pair besides force and gap. */
  struct PairPast
  {
    PairPast(const Vector3 &start = {}) : start(start) {}

    Vector3 start; ///< the gap at the start of the step [m]

    /** What the force is to be divided by for a stress [m^2]: the tributary area; twice that where the force
     * is twice the mean over the step (Newmark with the rule mean-force), whose stress is then the mean. */
    double area = 1.;
    bool   is_mean = false; ///< is the stress the mean over the step, or that at its end?

    /** JointLaw::n_memory() values: those committed at the start of the step, with the events of this one. */
    const double *memory = nullptr;
  };

  class SurfacesLaw;

  /** The conditions between the two faces of a joint at one pair, in the frame (n,a,b).
   *
   *  force: of side 1 on side 2 [N]; force[0] > 0 is compression. gap: displacement of side 2 against side 1
   *  since the joint was closed [m]; gap[0]: opening, >= 0. start: the gap at the start of the step; friction
   *  opposes gap - start: force_t = -mu force_n slip/|slip|. (The paper's P_tau has the opposite sign.)
   *
   *  A law is one object for all pairs of a joint and does not change. What it must remember of a pair lies
   * in the pair's memory, n_memory() values in the state that the time integration carries (halved steps,
   * checkpoints, statics); commit() brings it up to date when a step is accepted. */
  class JointLaw
  {
  public:
    virtual ~JointLaw() = default;

    /** The non-smooth equations of the pair, in forces. @p rho [N/m] makes them independent of units; any
     *  positive value has the same solution. */
    virtual void evaluate(const Vector3 &force, const Vector3 &gap, const PairPast &past, double rho,
                          PairEquations &equations) const = 0;

    /** What the pair misses, in forces: the measure of convergence, the same for all formulations of a law.
     *  For Coulomb's law the natural map (De Saxce and Feng 1998). */
    virtual Vector3 error(const Vector3 &force, const Vector3 &gap, const PairPast &past, double rho) const;

    /** Exact solution for one pair alone: the force with gap = H force + b. */
    virtual Vector3 solve(const Matrix3 &H, const Vector3 &b, const PairPast &past) const = 0;

    /** The impulse [N s] that the law allows when the velocity without it is @p v [m/s] and the surfaces
     *  @p touching touch; @p H: inverse mass [1/kg]; @p past: the same as in the equations of the step. */
    virtual Vector3 solve_impulse(const Matrix3 &H, const Vector3 &v, const PairPast &past,
                                  unsigned char touching) const = 0;

    /** As solve_impulse(), but the impulse @p spent stays, and only the velocity @p v normal to the touching
     *  surfaces is removed: never gives energy. */
    virtual Vector3 stop_normal(const Matrix3 &H, const Vector3 &v, const Vector3 &spent,
                                unsigned char touching) const;

    /** The contact force that goes with the acceleration @p b, given the velocity @p slip_velocity of side 2.
     */
    virtual Vector3 solve_acceleration(const Matrix3 &H, const Vector3 &b, const Vector3 &slip_velocity,
                                       double still, const PairPast &past, unsigned char touching) const;

    /** Are the tangential conditions those of a tie, whether the faces touch or not? */
    virtual bool is_tangentially_tied() const { return false; }

    /** Values that the law remembers of a pair; zeros at first. */
    virtual unsigned int n_memory() const { return 0; }

    /** Must the force be the mean over the step (Newmark with the rule mean-force)? */
    virtual bool needs_mean_force() const { return false; }

    /** How far a solution with this force and gap is beyond what the pair can carry, such as its tension over
     *  its strength: above 1 the pair, if it is among the worst, is released, and the step is solved again.
     */
    virtual double excess(const Vector3 &, const Vector3 &, const PairPast &) const { return 0.; }

    /** Puts the event (a bond that breaks, a key that meets its flank) into @p memory. */
    virtual void release(double *) const {}

    /** The step is accepted with this force and gap: bring @p memory up to date, to which past.memory points.
     */
    virtual void commit(const Vector3 &, const Vector3 &, const PairPast &, double *) const {}

    /** Energy that the bond holds and has lost (or the seats of keys hold), at a gap and a committed memory
     * [J]. @p area: tributary [m^2]. */
    virtual double bond_energy(const Vector3 &, double, const double *) const { return 0.; }

    /** The same law, if its pairs touch on several surfaces, each with a force of its own: the solver takes
     *  these, see PairSurfaces. */
    virtual const SurfacesLaw *surfaces_law() const { return nullptr; }

    /** Coefficient of friction if the law is Coulomb's on one flat face, -1 otherwise. */
    virtual double flat_friction() const { return -1.; }
  };
} // namespace Voussoir

#endif
