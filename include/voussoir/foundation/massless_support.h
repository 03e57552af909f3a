// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_massless_support_h
#define voussoir_massless_support_h

#include <voussoir/dynamics/support.h>
#include <voussoir/foundation/condensed_rock.h>

namespace Voussoir
{
  /** Massless rock under the feet of the dam: S (u + b u') = - force, b its stiffness-proportional damping.
   * It makes the steps of the dam by the same rule: the sum of that over both ends of a step,
   *
   *      (1 + 2 b / dt) S u_new = (2 b / dt - 1) S u_old - 2 force,
   *
   * with the mean force of the step. So the result is that of dam and rock as one body, but for round-off.
   * Steps can be halved three times. */
  class MasslessSupport : public Support
  {
  public:
    /** @p rock and @p standing must outlive this; @p dt: of a whole step of the dam. */
    MasslessSupport(const CondensedRock &rock, const StandingNodes &standing, double stiffness_damping,
                    double dt);

    const std::vector<unsigned int> &feet() const override { return standing.node; }
    unsigned int                     n_substeps() const override { return parts; }
    BlockSparseMatrix                compliance(unsigned int n) const override;
    Unknowns                         predict(unsigned int n, const Unknowns &at) override;
    void push(unsigned int n, const Unknowns &force, const Unknowns &place, double work) override;

    /** Counts its energies from the state of rest of the dam with displacement @p u [m]. */
    void start_account(const Unknowns &u);

    /** Strain energy now and at the start, what damping took, the work of the dam, and the largest of all
     * that [J]; a state. */
    std::vector<double> account;

    double strain_at_start() const; ///< [J]

    /** For energy.csv, see Foundation::energies(). */
    std::vector<std::pair<std::string, double>> energies() const;

    /** What the account misses over the largest energy that has gone through. */
    double balance_error() const;

  private:
    static constexpr unsigned int parts = 8; ///< that a step can be made of
    double   ratio(const unsigned int n) const { return 2. * damping * parts / (dt * n); }
    Unknowns of_rock(const Unknowns &of_nodes) const;
    double   energy(const Unknowns &a) const;

    const CondensedRock &rock;
    const StandingNodes &standing;
    const double         damping, dt;
    Unknowns             before; ///< the step
  };
} // namespace Voussoir

#endif
