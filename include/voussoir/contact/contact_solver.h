// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_contact_solver_h
#define voussoir_contact_solver_h

#include <voussoir/contact/contact_operator.h>
#include <voussoir/contact/contact_parameters.h>
#include <voussoir/contact/contact_result.h>
#include <voussoir/contact/surfaces_law.h>

namespace Voussoir
{
  /** Solver of the contact problem gap = W force + b with a joint law at each pair.
   *
   * The main stage is a semismooth Newton method with a nonmonotone line search (Grippo, Lampariello and
   * Lucidi 1986) and inexact linear solutions (Eisenstat and Walker 1996). A few Gauss-Seidel iterations with
   * the exact solution of each pair precede the first Newton step. If Newton stalls, more Gauss-Seidel
   * iterations follow. If Newton stalls again, the proximal point method follows: Newton solves regularised
   * problems with W + alpha D, where alpha falls with the residual (Rockafellar 1976; for friction: Acary,
   * Bremond and Huber 2018).
   *
   * Pairs with several contact surfaces (SurfacesLaw) have the forces of the secondary surfaces as
   * additional unknowns. PairSurfaces eliminates them pair by pair. Rigid flanks are solved with a small
   * contact compliance, 1e-3 of the flexibility of the pair, around the forces of the previous solution. This
   * is repeated until the forces no longer change.
   *
   * doc/method.md has the convergence criterion. The error over the load may also be below the round-off of W force,
   * 4 eps |W|/w min(|force|, 100 |b|/w), with the mean diagonal w of W. */
  class ContactSolver
  {
  public:
    // Values per pair have the components (n, a, b) of the frame of the pair. Forces are those of side 1 on
    // side 2, gaps are displacements of side 2 relative to side 1 (JointLaw). If several ranks share W, all
    // ranks call the constructor, solve() and guess_bonded(), with equal arguments.

    /** Prepares the solver for problems with the operator @p W.
     * @param W operator; must outlive the solver
     * @param laws joint law of each pair, W.n_pairs() in number; the laws must outlive the solver
     * @param parameters tolerance, limits and method */
    ContactSolver(const ContactOperator &W, std::vector<const JointLaw *> laws,
                  const ContactParameters &parameters);
    ~ContactSolver();

    /** Solves a contact problem, within the limits ContactParameters::max_iterations and max_seconds.
     * @param b gaps without joint forces, three values per pair [m]
     * @param history history of each pair
     * @param force receives the solution, three values per pair [N]; its initial value is the initial guess,
     * or zero if it is not finite
     * @param gap receives W force + b, three values per pair [m]
     *
     * Returns convergence and effort. If ContactResult::converged is false, @p force and @p gap are the best
     * iterate. This includes values of @p b or @p history that are not finite; there is no exception. */
    ContactResult solve(const Unknowns &b, const std::vector<PairHistory> &history, Unknowns &force,
                        Unknowns &gap);

    /** Solves a contact problem with laws without history variables. @p start: gap at the start of the step,
     * three values per pair [m]. */
    ContactResult solve(const Unknowns &b, const Unknowns &start, Unknowns &force, Unknowns &gap);

    /** Computes an initial guess for a static state: forces that keep all gaps at zero, W force + b = 0, with
     * a relative error of about 1e-3. Call it before solve().
     * @param b gaps without joint forces, three values per pair [m]
     * @param force receives three values per pair [N] */
    void guess_bonded(const Unknowns &b, Unknowns &force);

    /** Changes ContactParameters::tolerance for the next solutions. */
    void set_tolerance(const double value) { parameters.tolerance = value; }

    /** Returns the contact state of each pair in the last solution; before the first one, all are open. */
    const std::vector<PairState> &states() const { return state; }
    /** Returns the active surfaces of each pair in the last solution, see PairEquations::active; before the
     * first one, 0. */
    const std::vector<unsigned char> &active_surfaces() const { return active; }

  private:
    struct Iterate
    {
      Unknowns force, gap;
      Unknowns secondary; ///< forces of the secondary surfaces of all pairs [N]
    };
    struct Proximal ///< regularisation: gap + alpha D (force - centre)
    {
      double   alpha = 0.;
      Unknowns centre;
    };
    struct Best
    {
      double   residual = std::numeric_limits<double>::infinity();
      Unknowns force, secondary;
    };
    struct WithSurfaces ///< a pair that touches on several surfaces
    {
      std::size_t        pair, begin; ///< begin: first value in Iterate::secondary
      const SurfacesLaw *law;
      PairSurfaces       surfaces;
    };
    Iterate      first_guess(const Unknowns &b, const std::vector<PairHistory> &history, Unknowns &force);
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
    double       remember(const Iterate &x); ///< stores x if it is the best; returns its residual
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
    ContactParameters                   parameters;
    std::unique_ptr<ContactJacobian>    jacobian;
    std::vector<double>                 rho;            ///< scaling of the equations of each pair [N/m]
    double                              mean_rho;       ///< 1/w, scaling of the error [N/m]
    double                              norm_of_W = 0.; ///< 2-norm [m/N]
    std::vector<PairEquations>          equations;
    std::vector<WithSurfaces>           with_surfaces;
    std::vector<std::size_t>            number; ///< index of each pair in with_surfaces, or no_surfaces
    std::vector<std::size_t>
                           secondary_of_pair; ///< first value of each pair in Iterate::secondary, and the end
    std::vector<PairState> state;
    std::vector<unsigned char> active;
    std::vector<double>        of_pair; ///< work space

    Unknowns                        multiplied, product; ///< product = W multiplied, of the last refresh
    const Unknowns                 *b = nullptr;         ///< load of the present problem
    const std::vector<PairHistory> *history = nullptr;
    double                          scale = 0.;     ///< divisor of the last residual [N]
    double                          tolerance = 0.; ///< of the present stage
    double                          secondary_merit = 0., seat_alpha = 0.; ///< seat_alpha: see rigid_seats()
    double        drift = 0.; ///< error of gap by single precision, relative like the residual
    Proximal      proximal;
    Best          best;
    ContactResult result;
    double        deadline = 0.;
  };
} // namespace Voussoir

#endif
