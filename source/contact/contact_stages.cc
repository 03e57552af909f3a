// SPDX-License-Identifier: GPL-3.0-or-later
// Stages of a solution: Gauss-Seidel iterations, Newton's method, proximal point method.
#include <voussoir/contact/contact_solver.h>

#include <algorithm>
#include <cmath>
#include <ctime>

namespace Voussoir
{
  namespace
  {
    /** Returns the CPU time of the process [s]. Other processes do not affect this limit. */
    double cpu_time()
    {
      return double(std::clock()) / CLOCKS_PER_SEC;
    }

    bool is_finite(const Unknowns &x)
    {
      return std::all_of(x.begin(), x.end(), [](const double y) { return std::isfinite(y); });
    }

    bool is_finite(const std::vector<PairHistory> &history)
    {
      return std::all_of(history.begin(), history.end(),
                         [](const PairHistory &pair) { return std::isfinite(dot(pair.start, pair.start)); });
    }
  } // namespace

  bool ContactSolver::out_of_time() const
  {
    return cpu_time() > deadline;
  }

  void ContactSolver::regularise(const double alpha, const Iterate &x)
  {
    proximal.alpha = alpha;
    proximal.centre = x.force;
    for (WithSurfaces &pair : with_surfaces)
      pair.surfaces.regularise(alpha / rho[pair.pair], get(x.force, pair.pair),
                               x.secondary.data() + pair.begin);
  }

  /** Solves regularised problems around the last solution. Convergence is superlinear, since alpha falls with
   * the residual. After six failures in a row without progress, Gauss-Seidel iterations continue from the
   * present iterate: the best iterate would lead to the same failures. */
  bool ContactSolver::proximal_point(Iterate &x)
  {
    const auto here = [&]
    {
      regularise(0., x);
      return remember(x);
    };
    const bool   flat = with_surfaces.empty();
    double       now = here();
    double       boost = 1., halved = now; // last residual that was half of the one before
    double       lower = best.residual;    // residual that counts as progress
    unsigned int n_sweeps = 20, failures = 0, halved_at = result.iterations;
    while (now > tolerance && std::isfinite(now) && steps_left() > 0 && !out_of_time())
    {
      if (best.residual < .5 * halved)
      {
        halved = best.residual;
        halved_at = result.iterations;
      }
      // If Coulomb's law has several solutions, the iteration may not end. A reduced time step is better.
      else if (!flat && result.iterations > halved_at + 60)
        break;
      // Growing forces with a constant residual are typical of a problem without a solution.
      else if (flat && result.force_over_load > 1e4 && result.iterations > halved_at + 60)
        break;
      const double usual = 5. * result.residual, // not relative to the load, since forces may be much larger
          alpha = flat ? std::min(1., usual) * boost : std::min(1., usual * boost);
      regularise(alpha, x);
      const bool solved = newton(std::max(.1 * now, .3 * tolerance), 50, flat ? 15 : 4, x);
      now = here();
      failures = best.residual < .7 * lower ? 0 : failures + !solved;
      lower = failures == 0 ? best.residual : lower;
      if (solved)
        boost = std::max(1., (flat ? .3 : .1) * boost);
      else if (flat ? failures < 6 : alpha < 1.)
        boost *= 10.;
      else if (steps_left() > 0)
      {
        failures = 0;
        sweep(n_sweeps, x);
        refresh_gap(x);
        n_sweeps = std::min(2 * n_sweeps, flat ? 200u : 2000u);
        boost = 1.;
        now = here();
      }
    }
    return now <= tolerance;
  }

  bool ContactSolver::sweeps_only(Iterate &x)
  {
    result.path = ContactPath::sweeps;
    double now = best.residual;
    while (now > tolerance && !out_of_time() && result.sweeps < 1000 * std::size_t(parameters.max_iterations))
    {
      sweep(10, x);
      refresh_gap(x);
      now = remember(x);
    }
    return now <= tolerance;
  }

  /** Performs the stages for the present tolerance. */
  bool ContactSolver::stages(Iterate &x)
  {
    if (parameters.method == "sweeps")
      return sweeps_only(x);
    if (parameters.method == "newton")
    {
      // With secondary surfaces, a Newton step without progress is rarely followed by one with progress.
      const unsigned int patience = with_surfaces.empty() ? 15 : 4;
      sweep(parameters.sweeps, x);
      bool converged = newton(tolerance, steps_left(), patience, x);
      remember(x);
      if (!converged)
      {
        result.path = std::max(result.path, ContactPath::sweeps);
        sweep(20, x);
        converged = newton(tolerance, steps_left(), patience, x);
        remember(x);
      }
      if (converged)
        return true;
    }
    result.path = ContactPath::proximal;
    if (!with_surfaces.empty()) // with several solutions, earlier iterates are misleading
    {
      best = Best();
      std::fill(x.force.begin(), x.force.end(), 0.);
      std::fill(x.secondary.begin(), x.secondary.end(), 0.);
      refresh_gap(x);
    }
    if (parameters.method == "proximal")
    {
      sweep(parameters.sweeps, x);
      refresh_gap(x); // Gauss-Seidel works in single precision
    }
    return proximal_point(x);
  }

  /** Solves a problem with rigid flanks by a sequence of problems with an artificial compliance (seat_alpha,
   * relative to that of the pair). Each problem is centred at the forces of the previous solution. */
  void ContactSolver::rigid_seats(Iterate &x)
  {
    double       now = 1e-3; // typical error with a compliance of 1e-3
    unsigned int failures = 0;
    for (unsigned int i = 0; i < 200 && steps_left() > 0 && !out_of_time(); ++i)
    {
      tolerance = std::max(.1 * now, .3 * parameters.tolerance);
      evaluate(x);
      if (i == 0 || !newton(tolerance, steps_left(), 4, x))
      {
        best = Best();
        if (!stages(x))
        {
          if (++failures == 4)
            break;
          seat_alpha = std::min(1., 10. * seat_alpha);
        }
      }
      now = residual(x, true);
      if (now <= parameters.tolerance)
        break;
      for (WithSurfaces &pair : with_surfaces)
        pair.surfaces.recentre(x.secondary.data() + pair.begin, seat_alpha / rho[pair.pair]);
    }
    best = {now, x.force, x.secondary};
  }

  ContactResult ContactSolver::solve(const Unknowns &right_hand_side, const Unknowns &start, Unknowns &force,
                                     Unknowns &gap)
  {
    std::vector<PairHistory> pairs;
    for (std::size_t i = 0; i < law.size(); ++i)
      pairs.emplace_back(get(start, i));
    return solve(right_hand_side, pairs, force, gap);
  }

  void ContactSolver::guess_bonded(const Unknowns &right_hand_side, Unknowns &force)
  {
    constexpr double softness = 1e-4; // relative compliance of the pairs; bounds the forces for singular W
    jacobian->expect_far_coupling();
    for (std::size_t i = 0; i < law.size(); ++i)
    {
      equations[i] = PairEquations();
      for (unsigned int c = 0; c < 3; ++c)
      {
        equations[i].residual[c] = rho[i] * right_hand_side[3 * i + c];
        equations[i].d_gap[4 * c] = rho[i];
        equations[i].d_force[4 * c] = softness;
      }
    }
    jacobian->update(equations);
    Unknowns gap;
    jacobian->solve(1e-3, force, gap);
  }

  /** Starts a solution and returns the first iterate. Its forces are @p force, or zero if @p force has values
   * that are not finite. */
  ContactSolver::Iterate ContactSolver::first_guess(const Unknowns                 &right_hand_side,
                                                    const std::vector<PairHistory> &pairs, Unknowns &force)
  {
    b = &right_hand_side;
    history = &pairs;
    result = ContactResult();
    proximal.alpha = 0.;
    tolerance = parameters.tolerance;
    seat_alpha = 1e-3;
    best = Best();
    deadline = cpu_time() + parameters.max_seconds;
    jacobian->begin();
    Iterate x;
    x.force = force;
    if (!is_finite(x.force))
      x.force.assign(x.force.size(), 0.);
    for (WithSurfaces &pair : with_surfaces)
    {
      pair.surfaces.start(pair.law->present(pairs[pair.pair]), rho[pair.pair], seat_alpha / rho[pair.pair]);
      x.secondary.resize(pair.begin + 3 * pair.law->n_secondary());
    }
    refresh_gap(x);
    return x;
  }

  ContactResult ContactSolver::solve(const Unknowns &right_hand_side, const std::vector<PairHistory> &pairs,
                                     Unknowns &force, Unknowns &gap)
  {
    Iterate    x = first_guess(right_hand_side, pairs, force);
    const bool defined = is_finite(*b) && is_finite(pairs);
    if (defined)
    {
      best = {residual(x, true), x.force, x.secondary};
      // Test for open joints: Newton's method only approximates zero forces, which is insufficient if
      // b is zero.
      const Iterate none{Unknowns(force.size(), 0.), *b, Unknowns(x.secondary.size(), 0.)};
      if (best.residual > tolerance && residual(none, true) <= tolerance)
      {
        x = none;
        best = {residual(x, true), x.force, x.secondary};
      }
    }
    if (defined && best.residual > tolerance)
    {
      const bool rigid = std::any_of(with_surfaces.begin(), with_surfaces.end(),
                                     [](const WithSurfaces &pair) { return pair.surfaces.is_regularised(); });
      if (rigid)
        rigid_seats(x);
      else if (!stages(x) && std::isfinite(best.residual))
        set_force(x, best);
    }
    regularise(0., x);
    refresh_gap(x);
    evaluate(x);
    result.converged = residual(x, true) <= parameters.tolerance;
    if (const auto worst = std::max_element(of_pair.begin(), of_pair.end());
        worst != of_pair.end() && std::isfinite(*worst))
      result.worst_pair = worst - of_pair.begin();
    for (std::size_t i = 0; i < law.size(); ++i)
    {
      state[i] = equations[i].state;
      active[i] = equations[i].active;
    }
    for (const WithSurfaces &pair : with_surfaces)
      active[pair.pair] =
          pair.surfaces.closed_surfaces(get(x.force, pair.pair), get(x.gap, pair.pair), active[pair.pair]);
    force.swap(x.force);
    gap.swap(x.gap);
    return result;
  }
} // namespace Voussoir
