// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_surfaces_law_h
#define voussoir_surfaces_law_h

#include <voussoir/contact/pair_surfaces.h>

namespace Voussoir
{
  /** Law of a pair that touches on several flat surfaces with Coulomb friction: shear keys (KSM) and the
   * edges of keys that are part of the mesh. The contact solver uses the surfaces one by one, see
   * PairSurfaces. The functions for the pair as a whole serve impacts and tests.
   *
   * Coulomb's law can have several solutions. With much friction on the face a pair may either stop at a
   * flank or ride up on it. This requires a coefficient above tan(90 degrees - a + friction angle of the
   * flank), for the flank angle a; an example is 0.8 with smooth flanks of 60 degrees. Keys jam if the
   * friction of the flanks exceeds tan a. */
  class SurfacesLaw : public JointLaw
  {
  public:
    /** @param surfaces at most 8; the first is the face of the joint */
    explicit SurfacesLaw(std::vector<ContactSurface> surfaces);

    /** Returns the surfaces that can touch in a step, with the reference forces of
     * their contact compliances. */
    virtual PresentSurfaces present(const PairHistory &history) const;

    /** Returns the largest number of secondary surfaces. */
    std::size_t n_beside() const { return surfaces.size() - 1; }

    const SurfacesLaw *surfaces_law() const override { return this; }

    /** Returns a correction of the friction energy of a step [J]. Without it, the friction energy is the work
     * of the pair's force along the joint, with changed sign. In fact friction dissipates the work of each
     * surface's force along that surface, minus the energy stored by its contact compliance. The remaining
     * work is normal to the surfaces.
     * @param force force of the pair at the end of the step [N]
     * @param gap gap at the end of the step [m]
     * @param history data of the pair */
    double friction_correction(const Vector3 &force, const Vector3 &gap, const PairHistory &history) const;

    /** Computes the condensed equations for the secondary forces that correspond to the gap. Rigid flanks get
     * the compliance 1e-3/rho. */
    void    evaluate(const Vector3 &force, const Vector3 &gap, const PairHistory &history, double rho,
                     PairEquations &equations) const override;
    Vector3 solve(const Matrix3 &H, const Vector3 &b, const PairHistory &history) const override;
    Vector3 solve_impulse(const Matrix3 &H, const Vector3 &v, const PairHistory &history,
                          unsigned char touching) const override;
    Vector3 stop_normal(const Matrix3 &H, const Vector3 &v, const Vector3 &spent,
                        unsigned char touching) const override;
    Vector3 solve_acceleration(const Matrix3 &H, const Vector3 &b, const Vector3 &slip_velocity, double still,
                               const PairHistory &history, unsigned char touching) const override;

  private:
    /** Returns the forces of the secondary surfaces for a solution, three values per surface [N]. */
    static std::vector<double> forces_beside(const PresentSurfaces &now, const Vector3 &force,
                                             const Vector3 &gap);

  protected:
    /** Returns the active surfaces, rigid and without clearance, for an impact. */
    PresentSurfaces touching_surfaces(unsigned char touching, bool frictionless) const;

    const std::vector<ContactSurface> surfaces;
    const std::unique_ptr<JointLaw>   face; ///< the law if only the face touches
  };

  /** Solves one pair with several surfaces: gap = H sum_k Q_k^T r_k + b. Rigid flanks are solved by the
   * proximal point method. If the forces are not unique, its start from zero forces selects one solution.
   * @param present surfaces that can touch
   * @param H flexibility of the pair [m/N]
   * @param b gap without the forces [m]
   * @param beside receives the secondary forces [N]; may be null
   *
   * Returns the force of the pair [N]. */
  Vector3 solve_surfaces(PresentSurfaces present, const Matrix3 &H, const Vector3 &b,
                         std::vector<double> *beside = nullptr);
} // namespace Voussoir

#endif
