// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_pair_surfaces_h
#define voussoir_pair_surfaces_h

#include <voussoir/contact/joint_law.h>

#include <vector>

namespace Voussoir
{
  /** Flat contact surface of a pair: the face of a joint, a key flank, or a plane at an edge. A key flank may
   * have a contact compliance. */
  struct ContactSurface
  {
    Matrix3 axes;            ///< rows: normal from side 1 to side 2, two tangents; in the frame of the pair
    double  clearance = 0.;  ///< opening of the surface when the joint is closed without slip [m]
    double  friction = 0.;   ///< coefficient of friction [-]
    double  compliance = 0.; ///< contact compliance, equal in all directions [m/N]; 0: rigid
    Vector3 rest = {}; ///< reference force in the axes: the force at zero deformation of the compliance [N]

    /** Returns the distance between the sides, without deformation of the contact compliance [m]. @p gap: gap
     * of the pair [m]. */
    double distance(const Vector3 &gap) const { return (axes * gap)[0] + clearance; }

    /** Returns opening and slip of the step at this surface, in its axes [m].
     * @param gap gap of the pair [m]
     * @param start gap of the pair at the start of the step [m]
     * @param force force on the surface in its axes, which deforms the contact compliance [N] */
    Vector3 movement(const Vector3 &gap, const Vector3 &start, const Vector3 &force) const;

    /** Returns the force on the surface in its axes [N]. The compliance must be positive.
     * @param gap gap of the pair [m]
     * @param start gap of the pair at the start of the step [m] */
    Vector3 seat_force(const Vector3 &gap, const Vector3 &start) const;
  };

  /** Surfaces of a pair that can close in one step. The first is the face of the joint; the others are
   * secondary surfaces (key flanks, or the planes at an edge of the joint). */
  struct PresentSurfaces
  {
    std::vector<ContactSurface> surfaces; ///< the surfaces
    std::vector<unsigned char>  bits;     ///< bit of each surface in PairEquations::active
    Vector3                     start;    ///< gap at the start of the step, corrected for round-off [m]
  };

  /** Equations of a pair with a face and secondary surfaces, each with its own force and Coulomb's law in the
   * form of Alart and Curnier. The force R of the pair is the sum of the forces of all surfaces:
   *
   *    e_0(R - sum_k Q_k^T r_k, Q_0 g) = 0,   e_k(r_k, Q_k g + c_k (r_k - rest_k)) = 0,   k = 1...
   *
   * with the gap g, and force r_k, axes Q_k, compliance c_k and reference force rest_k of surface k. A pair
   * has more surfaces than displacement components. The compliances c_k make the forces r_k unique, because
   * each r_k then depends on g only. The r_k are therefore eliminated pair by pair, and the linear systems
   * keep three unknowns per pair, as for other laws. A rigid or nearly rigid flank gets an artificial
   * compliance. The proximal point method (Rockafellar 1976) removes its effect: rest_k is the previous force.
   *
   * Arguments named "secondary" contain the forces of the secondary surfaces, three values per surface in its axes
   * [N]. */
  class PairSurfaces
  {
  public:
    /** Starts a step. Secondary surfaces with a smaller compliance get the artificial compliance.
     * @param surfaces surfaces that can close in the step
     * @param rho scaling factor of the equations [N/m]
     * @param proximal artificial compliance [m/N] */
    void start(PresentSurfaces surfaces, double rho, double proximal);

    /** Returns the number of secondary surfaces. */
    std::size_t n_secondary() const { return present.surfaces.empty() ? 0 : present.surfaces.size() - 1; }

    /** Returns true if a secondary surface has an artificial compliance. */
    bool is_regularised() const { return regularised; }

    /** Starts the next proximal point iteration for the surfaces with an artificial compliance.
     * @param secondary present forces of the secondary surfaces, the new reference forces
     * @param proximal artificial compliance [m/N] */
    void recentre(const double *secondary, double proximal);

    /** Adds a compliance to all surfaces, including the face, until the next call.
     * @param proximal compliance [m/N]; 0: none
     * @param force present force of the pair [N]. The present forces are the reference forces.
     * @param secondary present forces of the secondary surfaces */
    void regularise(double proximal, const Vector3 &force, const double *secondary);

    /** Computes the equations of the pair.
     * @param force force of the pair [N]
     * @param gap gap of the pair [m]
     * @param secondary forces of the secondary surfaces
     * @param e receives the equations of the face
     *
     * Returns the squared norm of the residuals of the secondary surfaces [N^2]. */
    double evaluate(const Vector3 &force, const Vector3 &gap, const double *secondary, PairEquations &e);

    /** Eliminates the secondary surfaces from the equations @p e of the last evaluate().
     * @param e equations of the face; receives the equations of the pair
     * @param scaled true: the rows are scaled to the size of those of other laws
     *
     * The force of a secondary surface changes with its gap by Y = d r/d g, which is negative. With the
     * compliance c and the coefficient of friction mu, -Y is 1/c where the surface sticks. Where it slips in
     * the direction e, -Y is (n + mu e) n^T/c + k p p^T, with p normal to e in the surface. */
    void condense(PairEquations &e, bool scaled = true);

    /** Computes the changes of the forces of the secondary surfaces in a Newton step. The changes of force and
     * gap have the accuracy of the linear solver. The result is the best fit to both of them.
     * @param e equations of the pair from condense()
     * @param d_force change of the force of the pair [N]
     * @param d_gap change of the gap [m]
     * @param d_secondary receives the changes of the forces of the secondary surfaces [N] */
    void expand(const PairEquations &e, const Vector3 &d_force, const Vector3 &d_gap,
                double *d_secondary) const;

    /** Returns the squared error of all surfaces by their natural maps [N^2].
     * @param force force of the pair [N]
     * @param gap gap of the pair [m]
     * @param secondary forces of the secondary surfaces
     * @param rho scaling factor of the natural map [N/m]
     * @param rigid true: without the artificial compliances */
    double error_square(const Vector3 &force, const Vector3 &gap, const double *secondary, double rho,
                        bool rigid) const;

    /** Solves the pair alone: gap = H force + b.
     * @param H flexibility of the pair [m/N]
     * @param b gap without the force [m]
     * @param accuracy relative accuracy of the equations [-]
     * @param force initial guess of the force of the pair [N]
     * @param secondary initial guess of the forces of the secondary surfaces; receives the solution
     *
     * Returns the force of the pair [N]. */
    Vector3 solve(const Matrix3 &H, const Vector3 &b, double accuracy, Vector3 force, double *secondary);

    /** Returns the surfaces of the step, without artificial compliances. */
    const PresentSurfaces &surfaces() const { return present; }

    /** Returns the bits of all closed surfaces, or 0 if no surface carries force. Closed surfaces need not carry
     * force, such as the second flank of a key without clearance.
     * @param force force of the pair [N]
     * @param gap gap of the pair [m]
     * @param carrying bits of the surfaces that carry force */
    unsigned char closed_surfaces(const Vector3 &force, const Vector3 &gap, unsigned char carrying) const;

  private:
    static constexpr std::size_t max_secondary = 7;
    using Forces = std::array<double, 3 * max_secondary>;

    struct Secondary ///< a secondary surface
    {
      Vector3               from; ///< gap at the start of the step in the axes of the surface [m]
      double                rho;
      bool                  is_idle; ///< open and without force
      PairState             state;
      Vector3               residual;
      std::array<double, 2> direction; ///< direction of the friction force, if it slips
      double                shrink;    ///< limit of friction over the trial force, if it slips
      double                across;    ///< -d friction/d slip normal to the direction, if it slips [N/m]
      Vector3               constant;  ///< change of the force for a constant gap [N]
    };
    static void equations_of(const ContactSurface &s, const Vector3 &force, const Vector3 &gap,
                             Secondary &mine);
    static void resolve(const ContactSurface &s, Secondary &mine, Matrix3 &stiffness);
    static void find_change(const ContactSurface &s, const Secondary &mine, const Vector3 &d_gap,
                            double *change);
    bool        eliminate(Matrix3 &stiffness, Vector3 &constant);
    Vector3     face_force(Vector3 force, const double *secondary) const;
    double      newton(const Matrix3 &H, const Vector3 &b, double scale, double accuracy, Vector3 &force,
                       Forces &secondary);
    bool        face_alone(const Matrix3 &H, const Vector3 &b, Vector3 &force) const;

    PresentSurfaces             present;
    std::vector<ContactSurface> seats;   ///< surfaces with the artificial compliances
    std::vector<ContactSurface> regular; ///< surfaces of seats with the compliance of regularise()
    std::vector<Secondary>      other;
    double                      rho = 0.;      ///< scaling factor [N/m]
    double                      softest = 0.;  ///< smallest scaling factor of a surface [N/m]
    double                      own_size = 0.; ///< largest clearance, or compression by a reference force [m]
    bool                        regularised = false;
    bool                        has_plain_face = false; ///< the axes of the face are those of the pair
  };
} // namespace Voussoir

#endif
