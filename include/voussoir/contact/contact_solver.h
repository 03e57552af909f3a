// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_contact_solver_h
#define voussoir_contact_solver_h

#include <voussoir/contact/contact_operator.h>
#include <voussoir/contact/contact_parameters.h>
#include <voussoir/contact/contact_result.h>
#include <voussoir/contact/surfaces_law.h>

namespace Voussoir
{
  /** Finds the forces at all pairs: gap = W force + b, with a joint law at each pair.
   *
   *  Semismooth Newton with a nonmonotone line search (Grippo, Lampariello and Lucidi 1986), its linear
   *  systems solved to the accuracy that Newton can use (Eisenstat and Walker 1996). A few Gauss-Seidel
   *  sweeps with the exact solution of each pair settle the states before the first Newton step. When Newton
   *  stalls, more sweeps follow; when it stalls again, the proximal point method, whose regularised problems
   *  W + alpha D, alpha falling with the residual, Newton solves (Rockafellar 1976; for friction: Acary,
   * Bremond and Huber 2018).
   *
   *  Pairs that touch on several surfaces (SurfacesLaw) bring the forces of these as further unknowns, which
   *  are eliminated pair by pair (PairSurfaces). Where their seats are rigid the problem is solved with a
   * small compliance, 1e-3 of the pair's own flexibility, around the forces of the solution before, until
   * these stay.
   *
   *  Convergence: |error|/max(|force|, |b|/w, |gap|/w) <= tolerance, in 2-norms, w: mean diagonal of W. For
   *  Coulomb's law this is the full relative natural-map error of Siconos on the problem scaled to mean
   *  diagonal 1. And |error|/(|b|/w) <= tolerance, or |error| <= 4 eps |W| |force|/w, the round-off of
   *  W force: a problem without a solution, whose forces grow without bound, does not converge. Both do not
   *  depend on units. */
  class ContactSolver
  {
  public:
    /** @p laws: one per pair; they and @p W must outlive the solver. */
    ContactSolver(const ContactOperator &W, std::vector<const JointLaw *> laws,
                  const ContactParameters &parameters);
    ~ContactSolver();

    /** @p past: one per pair; @p force: the initial guess, then the solution; @p gap: receives W force + b.
     * All but
     *  @p past have three entries per pair. Not converged: the best found. */
    ContactResult solve(const Unknowns &b, const std::vector<PairPast> &past, Unknowns &force, Unknowns &gap);

    /** The same for laws without memory. @p start: gap at the start of the step, three entries per pair. */
    ContactResult solve(const Unknowns &b, const Unknowns &start, Unknowns &force, Unknowns &gap);

    /** The forces at which the gaps would stay as they are, W force + b = 0, nearly: a first guess for a
     * static state. */
    void guess_bonded(const Unknowns &b, Unknowns &force);

    const std::vector<PairState>     &states() const { return state; }   ///< of the last solution
    const std::vector<unsigned char> &touching() const { return touch; } ///< surfaces, as in PairEquations

    /** Smallest W_nn/|W_nt| of a pair: friction beyond it may jam (Klarbring 1990). */
    double critical_friction() const;

  private:
    struct Iterate
    {
      Unknowns force, gap;
      Unknowns beside; ///< forces of the surfaces beside the face, of all pairs that have them
    };
    struct Proximal ///< regularisation: gap + alpha D (force - centre)
    {
      double   alpha = 0.;
      Unknowns centre;
    };
    struct Best
    {
      double   residual = std::numeric_limits<double>::infinity();
      Unknowns force, beside;
    };
    struct WithSurfaces ///< a pair that touches on several surfaces
    {
      std::size_t        pair, begin; ///< begin: of its forces in Iterate::beside
      const SurfacesLaw *law;
      PairSurfaces       surfaces;
    };
    Iterate      first_guess(const Unknowns &b, const std::vector<PairPast> &past, Unknowns &force);
    bool         stages(Iterate &x);
    void         rigid_seats(Iterate &x);
    void         regularise(double alpha, const Iterate &x);
    void         evaluate(const Iterate &x);
    double       merit() const;
    double       residual(const Iterate &x, bool rigid = false);
    double       checked_residual(double target, double now, Iterate &x);
    double       forcing_term(double now, double previous, double target, bool stalls) const;
    void         refresh_gap(Iterate &x);
    void         set_force(Iterate &x, const Best &from);
    double       remember(const Iterate &x); ///< if it is the best; its residual
    bool         newton(double target, unsigned int max_steps, unsigned int patience, Iterate &x);
    double       newton_step(double forcing, double bound, Iterate &x);
    double       line_search(double bound, const Iterate &step, Iterate &x);
    void         sweep(unsigned int count, Iterate &x);
    bool         sweeps_only(Iterate &x);
    bool         proximal_point(Iterate &x);
    bool         out_of_time() const;
    Vector3      shifted_gap(std::size_t pair, const Iterate &x) const;
    unsigned int steps_left() const;

    const ContactOperator              &W;
    const std::vector<const JointLaw *> law;
    const ContactParameters             parameters;
    std::unique_ptr<ContactJacobian>    jacobian;
    std::vector<double>                 rho;            ///< per pair [N/m]
    double                              mean_rho;       ///< of the measure of convergence [N/m]
    double                              norm_of_W = 0.; ///< [m/N]
    std::vector<PairEquations>          equations;
    std::vector<WithSurfaces>           with_surfaces;
    std::vector<std::size_t>            number; ///< of each pair in with_surfaces, or none
    std::vector<std::size_t>   beside_of_pair;  ///< where its part of Iterate::beside begins, and the end
    std::vector<PairState>     state;
    std::vector<unsigned char> touch;
    std::vector<double>        of_pair; ///< work space

    Unknowns                     multiplied, product; ///< product = W multiplied, of the last refresh
    const Unknowns              *b = nullptr;         ///< of the present problem, as the next
    const std::vector<PairPast> *past = nullptr;
    double                       scale = 0.;          ///< of the last residual [N]
    double                       tolerance = 0.;      ///< of the present stage
    double        beside_merit = 0., seat_alpha = 0.; ///< compliance of rigid seats, relative to the pair's
    double        drift = 0.; ///< of gap from W force + b, by single precision; relative, as the residual
    Proximal      proximal;
    Best          best;
    ContactResult result;
    double        deadline = 0.;
  };
} // namespace Voussoir

#endif
