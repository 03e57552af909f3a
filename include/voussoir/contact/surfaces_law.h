// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_surfaces_law_h
#define voussoir_surfaces_law_h

#include <voussoir/contact/pair_surfaces.h>

#include <memory>

namespace Voussoir
{
  /** Law of a pair with several flat contact surfaces and Coulomb friction: shear keys (KSM), edges of meshed keys.
   * The first surface is the face of the joint; secondary surfaces are key flanks, or planes at an edge. The contact
   * solver treats each surface alone, see PairSurfaces; velocity corrections and tests treat the entire pair.
   *
   * Coulomb's law can have two solutions: a pair stops at a flank, or slides up the flank. The coefficient of
   * friction of the face is then above tan(90 degrees - a + friction angle of the flank), with the flank angle a.
   * Keys jam if the coefficient of friction of the flanks exceeds tan a. */
  class SurfacesLaw : public JointLaw
  {
  public:
    /** @param surfaces all surfaces of a pair, at most 8; the first is the face of the joint */
    explicit SurfacesLaw(std::vector<ContactSurface> surfaces);

    /** Returns the surfaces that can close in a step, with the reference forces of their contact compliances.
     * The default is all surfaces. @p history: data of the pair. */
    virtual PresentSurfaces present(const PairHistory &history) const;

    /** Returns the number of all secondary surfaces of a pair. */
    std::size_t n_secondary() const { return surfaces.size() - 1; }

    const SurfacesLaw *surfaces_law() const override { return this; }

    /** Returns D + W [J]: the friction energy D of a step, and the work W of the pair's force along the joint.
     * For a flat face D = -W. In general, D is minus the work of each surface's force along this surface,
     * minus the energy that the contact compliance of the surface stores in the step.
     * @param force force of the pair in the step [N]
     * @param gap gap at the end of the step [m]
     * @param history data of the pair, with the history variables at the start of the step */
    double friction_correction(const Vector3 &force, const Vector3 &gap, const PairHistory &history) const;

    /** Computes the equations of the pair. The forces of the secondary surfaces follow from the gap and are
     * eliminated (PairSurfaces::condense()). Rigid flanks get the compliance 1e-3/rho. */
    void    evaluate(const Vector3 &force, const Vector3 &gap, const PairHistory &history, double rho,
                     PairEquations &equations) const override;
    Vector3 solve(const Matrix3 &H, const Vector3 &b, const PairHistory &history) const override;
    Vector3 solve_impulse(const Matrix3 &H, const Vector3 &v, const PairHistory &history,
                          unsigned char active) const override;
    Vector3 stop_normal(const Matrix3 &H, const Vector3 &v, const Vector3 &applied,
                        unsigned char active) const override;

  private:
    /** Returns the forces of the secondary surfaces for the force and the gap of a solution, three values per
     * surface [N]. */
    static std::vector<double> secondary_forces(const PresentSurfaces &now, const Vector3 &force,
                                                const Vector3 &gap);

  protected:
    /** Returns the active surfaces, rigid and without clearance, for an impact.
     * @param active bits of the surfaces, see PairEquations::active
     * @param frictionless true: without friction */
    PresentSurfaces active_surfaces(unsigned char active, bool frictionless) const;

    const std::vector<ContactSurface> surfaces; ///< all surfaces; the first is the face
    const std::unique_ptr<JointLaw>   face;     ///< law of a pair in which only the face is active
  };

  /** Solves one pair with several surfaces: gap = H sum_k Q_k^T r_k + b, where r_k is the force of surface k
   * and Q_k its axes. Rigid flanks are solved by the proximal point method. If the forces are not unique, the
   * start from zero forces selects one solution.
   * @param present surfaces that can close
   * @param H flexibility of the pair [m/N]
   * @param b gap without the forces [m]
   * @param secondary receives the forces of the secondary surfaces, three values per surface [N]; may be null
   *
   * Returns the force of the pair: the sum of the forces of all surfaces [N]. */
  Vector3 solve_surfaces(PresentSurfaces present, const Matrix3 &H, const Vector3 &b,
                         std::vector<double> *secondary = nullptr);
} // namespace Voussoir

#endif
