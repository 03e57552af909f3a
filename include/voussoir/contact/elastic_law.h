// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_elastic_law_h
#define voussoir_elastic_law_h

#include <voussoir/contact/joint_law.h>
#include <voussoir/contact/law_parameters.h>

#include <memory>

namespace Voussoir
{
  /** Joint with a stiffness and an adhesion, and the law of its face, any with one surface.
   *
   * The stiffness is that of the joint itself, such as of a measured rock joint: the gap of the face is gap + D force,
   * with D = diag(1/(k_n A), 1/(k_t A), 1/(k_t A)) and the area A of the pair. So force_n >= 0,
   * gap_n + force_n/(k_n A) >= 0, and slip begins at the friction limit of the elastic tangential force. The elastic
   * slip is remembered. A stiffness of 0 means rigid. The force of a step, also if it is a mean, belongs to the gap at
   * its end; this never makes energy.
   *
   * The adhesion c moves the friction cone: |force_t| <= c A + mu force_n. The tension is limited to c A/mu. A pair
   * that opens loses its adhesion; slip alone does not.
   *
   * History variables: {0 bonded, 1 adhesion lost; stresses along n, a, b of the last step [Pa]}, then those of the
   * face. */
  class ElasticLaw : public JointLaw
  {
  public:
    /** @param face law of the face
     * @param parameters stiffnesses, adhesion, friction */
    ElasticLaw(std::unique_ptr<JointLaw> face, const LawParameters &parameters);

    /** Returns the compliance of the joint itself along n, a and b [m/N]; 0: rigid. @p area: of the pair [m^2]. */
    Vector3 compliance(double area) const;

    /** Returns the elastic energy of a pair [J]. The arguments are those of bond_energy(). */
    double stored_energy(double area, const double *memory) const;

    /** Returns true if the pair has a bond that can break. */
    bool has_bond() const { return tension > 0. || face->n_memory() > 0; }

    /** Returns the elastic energy that a step adds [J]. The arguments are those of friction_correction(). */
    double stored_change(const Vector3 &force, const PairHistory &history) const;

    /** Returns minus the elastic energy along the joint that a step adds [J], see SurfacesLaw::friction_correction().
     * @param force force of the pair in the step [N]
     * @param history data of the pair, with the history variables at the start of the step */
    double friction_correction(const Vector3 &force, const PairHistory &history) const;

    unsigned int      n_memory() const override { return n_own + face->n_memory(); }
    bool              needs_mean_force() const override { return true; }
    bool              is_tangentially_tied() const override { return face->is_tangentially_tied(); }
    const ElasticLaw *elastic_law() const override { return this; }
    void    evaluate(const Vector3 &force, const Vector3 &gap, const PairHistory &history, double rho,
                     PairEquations &equations) const override;
    Vector3 error(const Vector3 &force, const Vector3 &gap, const PairHistory &history,
                  double rho) const override;
    Vector3 solve(const Matrix3 &H, const Vector3 &b, const PairHistory &history) const override;
    Vector3 solve_impulse(const Matrix3 &H, const Vector3 &v, const PairHistory &history,
                          unsigned char active) const override;
    Vector3 stop_normal(const Matrix3 &H, const Vector3 &v, const Vector3 &applied,
                        unsigned char active) const override;
    double  utilisation(const Vector3 &force, const Vector3 &gap, const PairHistory &history) const override;
    void    apply_event(double *memory, JointEvent event) const override;
    void    commit(const Vector3 &force, const Vector3 &gap, const PairHistory &history,
                   double *memory) const override;
    double  bond_energy(const Vector3 &gap, double area, const double *memory) const override;

  private:
    enum Memory
    {
      lost,
      stress,
      n_own = stress + 3
    };
    struct OfFace;
    double change_of_row(unsigned int row, const Vector3 &force, const PairHistory &history) const;
    bool   is_bonded(const PairHistory &history) const { return tension > 0. && history.memory[lost] == 0.; }
    double softened(double rho, const PairHistory &history) const;

    const std::unique_ptr<JointLaw> face, tie;
    const Vector3                   flexibility; ///< of unit area, along n, a, b [m/Pa]
    const double                    tension;     ///< limit while bonded [Pa]
  };

  /** Returns an ElasticLaw, or @p face itself without stiffness and adhesion.
   *
   * Throws InputError for negative values, for an adhesion without friction, and for
   * equations other than "alart-curnier". */
  std::unique_ptr<JointLaw> make_elastic_law(std::unique_ptr<JointLaw> face, const LawParameters &parameters);
} // namespace Voussoir

#endif
