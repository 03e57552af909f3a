// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_pair_surfaces_h
#define voussoir_pair_surfaces_h

#include <voussoir/contact/joint_law.h>

#include <memory>
#include <vector>

namespace Voussoir
{
  /** Flat surface on which the two sides of a pair can touch. A key flank may have a contact compliance. */
  struct ContactSurface
  {
    Matrix3 axes;            ///< rows: normal from side 1 to side 2, two tangents; in the frame of the pair
    double  clearance = 0.;  ///< opening of the surface when the joint is closed [m]
    double  friction = 0.;   ///< coefficient of friction [-]
    double  compliance = 0.; ///< contact compliance, equal in all directions [m/N]; 0: rigid
    Vector3 rest = {};       ///< reference force [N]: the force without deformation of the contact compliance

    /** Returns the distance between the sides at a gap of the pair, without deformation of the
     * contact compliance [m]. */
    double distance(const Vector3 &gap) const { return (axes * gap)[0] + clearance; }

    /** Returns opening and slip at this surface [m].
     * @param gap gap of the pair [m]
     * @param start gap at the start of the step [m]
     * @param force force on the surface, which deforms the contact compliance [N] */
    Vector3 movement(const Vector3 &gap, const Vector3 &start, const Vector3 &force) const;

    /** Returns the force on the surface for a gap [N]. The compliance must be positive. */
    Vector3 seat_force(const Vector3 &gap, const Vector3 &start) const;
  };

  /** Surfaces of a pair that can touch in one step. The first is the face of the joint; the others are
   * secondary surfaces (key flanks, or the planes at an edge of the joint). */
  struct PresentSurfaces
  {
    std::vector<ContactSurface> surfaces;
    std::vector<unsigned char>  bits;  ///< bit of each surface in PairEquations::touching
    Vector3                     start; ///< gap at the start of the step, corrected for round-off [m]
  };

  /** Equations of a pair with a face and secondary surfaces, each with its own force and Coulomb's law in the
   * form of Alart and Curnier. The force R of the pair is the sum of the forces of all surfaces:
   *
   *    e_0(R - sum_k Q_k^T r_k, Q_0 g) = 0,   e_k(r_k, Q_k g + c_k (r_k - rest_k)) = 0,   k = 1...
   *
   * A pair has more surfaces than displacement components. The contact compliances c_k make the forces r_k
   * unique, since each r_k then follows from g alone. The r_k are therefore eliminated pair by pair. The
   * linear systems keep three unknowns per pair, as for the other laws. A rigid or nearly rigid flank gets an
   * artificial compliance, whose effect is removed by the proximal point method (Rockafellar 1976): rest_k is
   * the previous force. */
  class PairSurfaces
  {
  public:
    /** Starts a step. Flanks with a smaller compliance get the artificial compliance @p proximal [m/N].
     * @param surfaces surfaces that can touch in the step
     * @param rho scaling factor of the equations [N/m]
     * @param proximal artificial compliance [m/N] */
    void start(PresentSurfaces surfaces, double rho, double proximal);

    /** Returns the number of secondary surfaces. */
    std::size_t n_beside() const { return present.surfaces.empty() ? 0 : present.surfaces.size() - 1; }

    /** Returns whether a secondary surface has an artificial compliance. */
    bool is_regularised() const { return regularised; }

    /** Sets the reference forces of rigid flanks to @p beside, the present forces of the secondary surfaces,
     * and their compliance to @p proximal [m/N]. */
    void recentre(const double *beside, double proximal);

    /** Adds the compliance @p proximal to all surfaces, also to the face, until the next call. The present
     * forces @p force and @p beside are the reference. 0: none. */
    void regularise(double proximal, const Vector3 &force, const double *beside);

    /** Computes the equations of the pair for its force, its gap and the forces @p beside of the secondary
     * surfaces. @p e receives the equations of the face. Returns the squared norm of the residuals of the
     * secondary surfaces [N^2]. */
    double evaluate(const Vector3 &force, const Vector3 &gap, const double *beside, PairEquations &e);

    /** Eliminates the secondary surfaces from the equations @p e of the last evaluate().
     * @param e equations of the pair
     * @param scaled whether to scale the rows to the size of those of other laws
     *
     * The force of a secondary surface changes with its gap by Y = d r/d g, which is negative. With the
     * compliance c and the coefficient of friction mu, -Y is 1/c where the surface sticks. Where it slips in
     * the direction e, -Y is (n + mu e) n^T/c + k p p^T, with p normal to e in the surface. */
    void condense(PairEquations &e, bool scaled = true);

    /** Computes the changes of the secondary forces in a Newton step with the condensed equations @p e. The
     * changes @p d_force and @p d_gap have the accuracy of the linear solver only. The result is the best fit
     * to both of them.
     * @param e condensed equations
     * @param d_force change of the force of the pair [N]
     * @param d_gap change of the gap [m]
     * @param d_beside receives the changes of the secondary forces [N] */
    void expand(const PairEquations &e, const Vector3 &d_force, const Vector3 &d_gap, double *d_beside) const;

    /** Returns the squared error of all surfaces by their natural maps [N^2]. @p rigid: without
     * the artificial compliances. */
    double error_square(const Vector3 &force, const Vector3 &gap, const double *beside, double rho,
                        bool rigid) const;

    /** Solves the pair alone: gap = H force + b.
     * @param H flexibility of the pair [m/N]
     * @param b gap without the force [m]
     * @param accuracy relative accuracy of the equations
     * @param force initial guess of the force [N]
     * @param beside initial guess and result of the secondary forces [N]
     *
     * Returns the force of the pair [N]. */
    Vector3 solve(const Matrix3 &H, const Vector3 &b, double accuracy, Vector3 force, double *beside);

    /** Returns the surfaces of the step, without artificial compliances. */
    const PresentSurfaces &surfaces() const { return present; }

    /** Returns the bits of all closed surfaces, or 0 if no surface carries force. The second flank of a key
     * without clearance is closed, too. @p carrying: bits of the surfaces that carry force. */
    unsigned char touching(const Vector3 &force, const Vector3 &gap, unsigned char carrying) const;

  private:
    static constexpr std::size_t max_beside = 7;
    using Forces = std::array<double, 3 * max_beside>;

    struct Beside ///< a secondary surface
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
    static void equations_of(const ContactSurface &s, const Vector3 &force, const Vector3 &gap, Beside &mine);
    static void resolve(const ContactSurface &s, Beside &mine, Matrix3 &stiffness);
    static void find_change(const ContactSurface &s, const Beside &mine, const Vector3 &d_gap,
                            double *change);
    bool        eliminate(Matrix3 &stiffness, Vector3 &constant);
    Vector3     face_force(Vector3 force, const double *beside) const;
    double      newton(const Matrix3 &H, const Vector3 &b, double scale, double accuracy, Vector3 &force,
                       Forces &beside);
    bool        face_alone(const Matrix3 &H, const Vector3 &b, Vector3 &force) const;

    PresentSurfaces             present;
    std::vector<ContactSurface> seats;   ///< surfaces with the artificial compliances
    std::vector<ContactSurface> regular; ///< seats with the compliance of regularise()
    std::vector<Beside>         other;
    double                      rho = 0.;      ///< scaling factor [N/m]
    double                      softest = 0.;  ///< smallest scaling factor of a surface [N/m]
    double                      own_size = 0.; ///< face axes = pair axes?
    bool                        regularised = false;
    bool                        has_plain_face = false; ///< the axes of the face are those of the pair
  };
} // namespace Voussoir

#endif
