#ifndef voussoir_joint_law_h
#define voussoir_joint_law_h

#include <voussoir/structure.h>

#include <memory>
#include <string>

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
    Vector3 residual; ///< [N]
    Matrix3 d_force;  ///< d residual / d force [-]
    Matrix3 d_gap;    ///< d residual / d gap [N/m]
  };

  /** The conditions between the two faces of a joint at one pair, in the frame (n,a,b).
   *
   *  force: of side 1 on side 2 [N]; force[0] > 0 is compression. gap[0]: opening [m], >= 0; gap[1..2]:
   * tangential displacement of side 2 against side 1, increment of the step [m]. Friction opposes slip:
   *  force_t = -mu force_n slip/|slip|. (The paper's P_tau has the opposite sign.) */
  class JointLaw
  {
  public:
    virtual ~JointLaw() = default;

    /** The non-smooth equations of the paper, (2b), (3b), (4b), (5), (6), in forces. @p rho [N/m] makes them
     *  independent of units; any positive value has the same solution. */
    virtual PairState evaluate(const Vector3 &force, const Vector3 &gap, double rho,
                               PairEquations &equations) const = 0;

    /** Exact solution for one pair alone: the force with gap = H force + b. @p closed: may the faces touch?
     *  Also the law of impulses (H: inverse mass, b: velocity). */
    virtual Vector3 solve(const Matrix3 &H, const Vector3 &b, bool closed) const = 0;

    /** The contact force that goes with the acceleration @p b, given the velocity @p slip_velocity of side 2.
     */
    virtual Vector3 solve_acceleration(const Matrix3 &H, const Vector3 &b, const Vector3 &slip_velocity,
                                       double still, bool closed) const;

    /** Are the tangential conditions those of a tie, whether the faces touch or not? */
    virtual bool is_tangentially_tied() const { return false; }
  };

  /** The law of that name: FJA, FJB, tied; with the equations of that name: projection (Alart and Curnier's
   *  form: the paper's equations with the slip angle of the trial force) or paper (the angle of the force
   * itself). Throws InputError for an unknown name. @p friction: coefficient of friction [-]. */
  std::unique_ptr<JointLaw> make_joint_law(const std::string &name, double friction,
                                           const std::string &equations = "projection");

  /** The names of the laws as a ParameterHandler selection: "tied|FJA|FJB". */
  std::string joint_law_names();
} // namespace Voussoir

#endif
