// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_key_law_h
#define voussoir_key_law_h

#include <voussoir/contact/contact_surfaces.h>
#include <voussoir/contact/fja_law.h>

namespace Voussoir
{
  /** A pair that touches on several flat surfaces: one admissible set, whatever their number. The equations
   *  are force = force of these surfaces for the compliance 1/rho (for one surface: Alart and Curnier's).
   *
   *  The forces of a wedge need not be unique. What only self-stress makes so, two flanks of a tight key
   *  pressed against each other, is excluded: one flank of a key carries at a time, the limit of a clearance
   *  that vanishes. What Coulomb's law itself leaves open remains: where the face has more friction than a
   *  flank needs to ride (its friction above tan(90 degrees - a + friction angle of the flank), such as 0.8
   *  beside smooth flanks of 60 degrees), a pair may stay before the flank or ride on it; and keys jam where
   *  the flanks' friction is above tan a. Of two solutions that are found, the equations take the one nearer
   *  to the force. Equal friction on face and flanks, the default of KeyParameters, is nearly free of this.
   */
  class SurfacesLaw : public JointLaw
  {
  public:
    /** @p surfaces: at most 8; the first is the joint's face. */
    explicit SurfacesLaw(std::vector<ContactSurface> surfaces)
        : surfaces(std::move(surfaces)), face(make_fja_law(this->surfaces[0].friction))
    {
    }

    void    evaluate(const Vector3 &force, const Vector3 &gap, const PairPast &past, double rho,
                     PairEquations &equations) const override;
    Vector3 solve(const Matrix3 &H, const Vector3 &b, const PairPast &past) const override;
    Vector3 solve_impulse(const Matrix3 &H, const Vector3 &v, unsigned char touching) const override;
    Vector3 stop_normal(const Matrix3 &H, const Vector3 &v, const Vector3 &spent,
                        unsigned char touching) const override;
    Vector3 solve_acceleration(const Matrix3 &H, const Vector3 &b, const Vector3 &slip_velocity, double still,
                               unsigned char touching) const override;

  protected:
    /** The surfaces that can touch in a step that starts from @p start, and their bits. May free @p start of
     *  round-off. */
    virtual void present(Vector3 &start, std::vector<ContactSurface> &list,
                         std::vector<unsigned char> &bits) const;

    std::vector<ContactSurface> touching_surfaces(unsigned char touching, bool frictionless) const;

    const std::vector<ContactSurface> surfaces;
    const std::unique_ptr<JointLaw>   face; ///< the law where nothing but the joint's face touches
  };

  /** Law KSM: a flat face with shear keys. Throws InputError for keys that cannot be. */
  std::unique_ptr<JointLaw> make_key_law(const LawParameters &parameters);
} // namespace Voussoir

#endif
