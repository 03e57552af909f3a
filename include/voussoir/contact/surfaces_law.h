// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_surfaces_law_h
#define voussoir_surfaces_law_h

#include <voussoir/contact/pair_surfaces.h>

namespace Voussoir
{
  /** A pair that touches on several flat surfaces, with Coulomb friction on each: shear keys by law (KSM),
   * and the edges of meshed ones. The solver takes the surfaces one by one (PairSurfaces); what is here of
   * the pair as a whole is for single pairs: impacts, and tests.
   *
   *  What Coulomb's law itself leaves open remains so: where the face has more friction than a flank needs to
   *  ride (above tan(90 degrees - a + friction angle of the flank), such as 0.8 beside smooth flanks of
   *  60 degrees), a pair may stay before the flank or ride on it; and keys jam where the flanks' friction is
   *  above tan a. */
  class SurfacesLaw : public JointLaw
  {
  public:
    /** @p surfaces: at most 8; the first is the joint's face. */
    explicit SurfacesLaw(std::vector<ContactSurface> surfaces);

    /** The surfaces that can touch in a step, with the state of their seats. */
    virtual PresentSurfaces present(const PairPast &past) const;

    /** How many, beside the face, there can be. */
    std::size_t n_beside() const { return surfaces.size() - 1; }

    const SurfacesLaw *surfaces_law() const override { return this; }

    /** Difference between the energy that friction takes in a step and the work of the force along the joint
     * [N m]. Friction takes the work of each surface's force along that surface, less what an elastic seat
     * stores of it; the rest is work normal to the surfaces.
     * @p force: of the pair at the end of the step [N]; @p gap: there [m]. */
    double friction_correction(const Vector3 &force, const Vector3 &gap, const PairPast &past) const;

    /** The forces beside the face are those that go with the gap, rigid seats having the compliance 1e-3/rho.
     */
    void    evaluate(const Vector3 &force, const Vector3 &gap, const PairPast &past, double rho,
                     PairEquations &equations) const override;
    Vector3 solve(const Matrix3 &H, const Vector3 &b, const PairPast &past) const override;
    Vector3 solve_impulse(const Matrix3 &H, const Vector3 &v, const PairPast &past,
                          unsigned char touching) const override;
    Vector3 stop_normal(const Matrix3 &H, const Vector3 &v, const Vector3 &spent,
                        unsigned char touching) const override;
    Vector3 solve_acceleration(const Matrix3 &H, const Vector3 &b, const Vector3 &slip_velocity, double still,
                               const PairPast &past, unsigned char touching) const override;

  private:
    /** Forces of the surfaces beside the face that go with a solution, 3 per surface [N]. */
    static std::vector<double> forces_beside(const PresentSurfaces &now, const Vector3 &force,
                                             const Vector3 &gap);

  protected:
    PresentSurfaces touching_surfaces(unsigned char touching, bool frictionless) const;

    const std::vector<ContactSurface> surfaces;
    const std::unique_ptr<JointLaw>   face; ///< the law where nothing but the joint's face touches
  };

  /** Solves gap = H sum_k Q_k^T r_k + b for one pair, rigid seats by proximal points from zero forces, which
   *  choose among forces that are not unique. @p beside: receives the forces beside the face, if any. */
  Vector3 solve_surfaces(PresentSurfaces present, const Matrix3 &H, const Vector3 &b,
                         std::vector<double> *beside = nullptr);
} // namespace Voussoir

#endif
