// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_massless_support_h
#define voussoir_massless_support_h

#include <voussoir/dynamics/support.h>
#include <voussoir/foundation/base_motion.h>
#include <voussoir/foundation/condensed_rock.h>

namespace Voussoir
{
  /** Massless rock as support of the dam: S (u + b u') = - force, with stiffness-proportional damping b. The
   * trapezoidal rule of the dam gives for one time step
   *
   *      (1 + 2 b / dt) S u_new = (2 b / dt - 1) S u_old - 2 force,
   *
   * with the mean force of the step. With a sustained modulus E_s of the rock, u is the displacement minus
   * (1 - E_s/E) times the static one. With different motions of the banks, u is also relative to the
   * displacement of the rock without the dam (BaseMotion). Up to round-off the result is that of dam and rock
   * as one body. A time step can be halved three times. */
  class MasslessSupport : public Support
  {
  public:
    /** Stores the references @p rock and @p dam_nodes, which must outlive the object.
     *
     * @param rock condensed stiffness of the rock
     * @param dam_nodes dam nodes on the rock
     * @param stiffness_damping damping factor b [s]
     * @param dt time step of the dam, without reduction [s]
     * @param offset displacement without force, three values per dam node [m]; empty: zero
     * @param motion motion of the rock at the dam nodes without the dam, relative to the ground motion; null: none.
     * It must outlive the object. */
    MasslessSupport(const CondensedRock &rock, const DamNodes &dam_nodes, double stiffness_damping, double dt,
                    const Unknowns &offset = {}, const BaseMotion *motion = nullptr);

    const std::vector<unsigned int> &base_nodes() const override { return dam_nodes.node; }
    unsigned int                     n_substeps() const override { return n_full; }
    BlockSparseMatrix                compliance(unsigned int n) const override;
    Unknowns                         predict(unsigned int n, double time, const Unknowns &at) override;
    void advance(unsigned int n, const Unknowns &force, const Unknowns &place, double work) override;

    /** Sets the energies to those of the static state. Must be called before the first advance() if energies
     * are required. @p u: static displacement of the dam, three values per node [m]. */
    void start_account(const Unknowns &u);

    /** Current strain energy, strain energy of the static state, damping, work of the dam, and largest of
     * these energies [J]. Stored in checkpoints. Empty before start_account(). */
    std::vector<double> account;

    /** Returns the strain energy of the static state [J]; 0 before start_account(). */
    double strain_at_start() const;

    /** Returns the energies [J] with their column names in energy.csv: Foundation::energies(). Must be called
     * after start_account(). */
    std::vector<std::pair<std::string, double>> energies() const;

    /** Returns the current error of the energy balance, relative to the largest energy so far, or to 1e-6 of
     * strain_at_start() if this is larger [-]. */
    double balance_error() const;

  private:
    static constexpr unsigned int n_full = 8; ///< substeps of the full time step
    double   ratio(const unsigned int n) const { return 2. * damping * n_full / (dt * n); } ///< 2 b / dt [-]
    Unknowns of_rock(const Unknowns &of_nodes) const;
    Unknowns offset_at(double time) const;
    double   energy(const Unknowns &a) const;

    const CondensedRock &rock;
    const DamNodes      &dam_nodes;
    const double         damping, dt; ///< damping factor b [s], time step [s]
    const Unknowns       offset;      ///< displacement without force [m], or empty
    const BaseMotion    *motion;      ///< or null
    Unknowns             before;      ///< displacement at the start of the step, without its offset [m]
    Unknowns             from, to;    ///< offset at the start and at the end of the step [m], or empty
  };
} // namespace Voussoir

#endif
