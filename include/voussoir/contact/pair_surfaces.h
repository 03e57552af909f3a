// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_pair_surfaces_h
#define voussoir_pair_surfaces_h

#include <voussoir/contact/joint_law.h>

#include <memory>
#include <vector>

namespace Voussoir
{
  /** One flat surface on which the two sides of a pair can touch. */
  struct ContactSurface
  {
    Matrix3 axes;            ///< rows: normal from side 1 to side 2, two tangents; in the frame of the pair
    double  clearance = 0.;  ///< opening of the surface when the joint is closed [m]
    double  friction = 0.;   ///< [-]
    double  compliance = 0.; ///< of its seat, in all directions [m/N]
    Vector3 rest = {};       ///< force at which the seat is not deformed [N]; of an elastic one, its friction

    /** How far the sides are apart here at a gap of the pair, the seat not deformed [m]. */
    double distance(const Vector3 &gap) const { return (axes * gap)[0] + clearance; }

    /** Opening and slip here of a pair that was at @p start, the seat being deformed by @p force [m]. */
    Vector3 movement(const Vector3 &gap, const Vector3 &start, const Vector3 &force) const;

    /** The force that goes with a gap, for a compliance above 0. */
    Vector3 seat_force(const Vector3 &gap, const Vector3 &start) const;
  };

  /** The surfaces of a pair that can touch in one step; the first is the joint's face. */
  struct PresentSurfaces
  {
    std::vector<ContactSurface> surfaces;
    std::vector<unsigned char>  bits;  ///< of PairEquations::touching
    Vector3                     start; ///< gap at the start of the step, free of round-off [m]
  };

  /** The equations of a pair that touches on several surfaces, each with a force of its own (Coulomb's law in
   *  Alart and Curnier's form): that of the face is what the others leave of the pair's force,
   *
   *    e_0(R - sum_k Q_k^T r_k, Q_0 g) = 0,   e_k(r_k, Q_k g + c_k (r_k - rest_k)) = 0,   k = 1...
   *
   *  The seats' compliance c_k makes the r_k unique, since the surfaces are more than the pair's three
   *  displacements: with it each r_k follows from g alone. So they are eliminated pair by pair, and the
   *  linear systems have three unknowns per pair, as those of other laws. A seat that is rigid, or
   *  nearly, has a compliance that the solver gives and takes away again: proximal points (Rockafellar 1976),
   * rest_k: the force before. */
  class PairSurfaces
  {
  public:
    /** Starts a step. @p proximal: compliance that seats are given which have less [m/N]. */
    void start(PresentSurfaces surfaces, double rho, double proximal);

    /** Number of surfaces beside the face. */
    std::size_t n_beside() const { return present.surfaces.empty() ? 0 : present.surfaces.size() - 1; }

    /** Is a seat stiffer, its compliance for the solution only? */
    bool is_regularised() const { return regularised; }

    /** The next proximal point of the rigid seats is @p beside: the forces of the surfaces beside the face.
     */
    void recentre(const double *beside, double proximal);

    /** Gives every surface, the face, too, the compliance @p proximal more around these forces, until the
     * next call; 0: none. */
    void regularise(double proximal, const Vector3 &force, const double *beside);

    /** The equations at the pair's force and gap and the forces @p beside. Returns the square of those of the
     *  surfaces beside the face; those of the face are in @p e. */
    double evaluate(const Vector3 &force, const Vector3 &gap, const double *beside, PairEquations &e);

    /** Replaces @p e, as last evaluated, by equations from which the other surfaces are eliminated. @p
     * scaled: their rows brought to the size of those of other laws. The forces of a surface of friction mu
     * change with its gap g by Y = d r/d g, negative: (n + mu e) n^T/c + k p p^T where it slips in the
     * direction e (p across it), 1/c where it sticks, c being its compliance. */
    void condense(PairEquations &e, bool scaled = true);

    /** Changes of the forces beside the face in a Newton step with the condensed equations @p e: those that
     *  go best with the changes of force and gap, which are exact to some digits only. @p shift: of the gap,
     * per force [m/N]. */
    void expand(const PairEquations &e, const Vector3 &d_force, const Vector3 &d_gap, double *d_beside) const;

    /** What the surfaces miss, in forces [N], squared: natural maps. @p rigid: without what the
     *  solver gave. */
    double error_square(const Vector3 &force, const Vector3 &gap, const double *beside, double rho,
                        bool rigid) const;

    /** Solves the pair alone: gap = H force + b, from the present forces, to @p accuracy, relative. Returns
     * the pair's force. */
    Vector3 solve(const Matrix3 &H, const Vector3 &b, double accuracy, Vector3 force, double *beside);

    const PresentSurfaces &surfaces() const { return present; }

    /** Bits of the surfaces that touch, when those of @p carrying carry force: the other flank of a tight
     * key, too, if any does. */
    unsigned char touching(const Vector3 &force, const Vector3 &gap, unsigned char carrying) const;

  private:
    static constexpr std::size_t max_beside = 7;
    using Forces = std::array<double, 3 * max_beside>;

    struct Beside ///< a surface beside the face
    {
      Vector3               from; ///< the start of the step in its axes [m]
      double                rho;
      bool                  is_idle; ///< open, and without force?
      PairState             state;
      Vector3               residual;
      std::array<double, 2> direction; ///< of the friction, where it slips
      double                shrink;    ///< friction over what it would be without a limit, where it slips
      double                across;    ///< d friction/d slip across that direction, its sign changed [N/m]
      Vector3               constant;  ///< change of the force where the gap stays
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
    std::vector<ContactSurface> seats;   ///< with the compliance that stiff seats are given
    std::vector<ContactSurface> regular; ///< with that of regularise(), too
    std::vector<Beside>         other;
    double                      rho = 0.;      ///< [N/m]
    double                      softest = 0.;  ///< the smallest rho of a surface [N/m]
    double                      own_size = 0.; ///< of clearances and of seats at rest [m]
    bool                        regularised = false;
    bool                        has_plain_face = false; ///< are the face's axes those of the pair?
  };
} // namespace Voussoir

#endif
