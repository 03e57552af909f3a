// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/contact/contact_solver.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>

namespace Voussoir
{
  namespace
  {
    void add(Unknowns &y, const double factor, const Unknowns &x)
    {
      for (std::size_t i = 0; i < y.size(); ++i)
        y[i] += factor * x[i];
    }

    double norm_square(const Unknowns &x)
    {
      double sum = 0.;
      for (const double y : x)
        sum += y * y;
      return sum;
    }

    /** Of the starts. */
    double norm_square(const std::vector<PairPast> &past)
    {
      double sum = 0.;
      for (const PairPast &pair : past)
        for (const double y : pair.start)
          sum += y * y;
      return sum;
    }

    bool is_finite(const Unknowns &x)
    {
      return std::all_of(x.begin(), x.end(), [](const double y) { return std::isfinite(y); });
    }

    double wall_time()
    {
      return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    }

    /** Largest eigenvalue of the symmetric part of a positive definite 3x3 matrix: power method with
     *  squaring. */
    double largest_eigenvalue(Matrix3 a)
    {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < i; ++j)
          a[3 * i + j] = a[3 * j + i] = .5 * (a[3 * i + j] + a[3 * j + i]);
      double trace = a[0] + a[4] + a[8], log_scale = 0.;
      if (!(trace > 0.))
        return 0.;
      for (unsigned int squaring = 0; squaring < 6; ++squaring)
      {
        for (double &x : a)
          x /= trace;
        log_scale = 2. * (log_scale + std::log(trace));
        Matrix3 b;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            b[3 * i + j] = a[3 * i] * a[j] + a[3 * i + 1] * a[3 + j] + a[3 * i + 2] * a[6 + j];
        a = b;
        trace = a[0] + a[4] + a[8];
      }
      return std::exp((log_scale + std::log(trace)) / 64.); // (trace A^64)^(1/64), within 2 % from above
    }
  } // namespace

  ContactSolver::ContactSolver(const ContactOperator &W, std::vector<const JointLaw *> laws,
                               const ContactParameters &parameters)
      : W(W), law(std::move(laws)), parameters(parameters), jacobian(W.make_jacobian()),
        equations(law.size()), state(law.size(), PairState::open), touch(law.size(), 0)
  {
    double trace = 0.;
    for (std::size_t i = 0; i < law.size(); ++i)
    {
      const Matrix3 H = W.diagonal(i);
      trace += H[0] + H[4] + H[8];
      const double largest = largest_eigenvalue(H);
      rho.push_back(largest > 0. ? 1. / largest : 0.);
    }
    mean_rho = trace > 0. ? 3. * law.size() / trace : 1.;
    for (double &r : rho)
      if (!(r > 0.))
        r = mean_rho;
  }

  ContactSolver::~ContactSolver() = default;

  double ContactSolver::critical_friction() const
  {
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < law.size(); ++i)
    {
      const Matrix3 H = W.diagonal(i);
      smallest = std::min(smallest, H[0] / std::max(std::hypot(H[1], H[2]), 1e-300));
    }
    return smallest;
  }

  Vector3 ContactSolver::shifted_gap(const std::size_t i, const Unknowns &force, const Unknowns &gap) const
  {
    Vector3 g = get(gap, i);
    if (proximal.alpha > 0.)
      for (unsigned int c = 0; c < 3; ++c)
        g[c] += proximal.alpha / rho[i] * (force[3 * i + c] - proximal.centre[3 * i + c]);
    return g;
  }

  void ContactSolver::evaluate(const Unknowns &force, const Unknowns &gap)
  {
    for (std::size_t i = 0; i < law.size(); ++i)
      law[i]->evaluate(get(force, i), shifted_gap(i, force, gap), (*past)[i], rho[i], equations[i]);
  }

  double ContactSolver::merit() const
  {
    double sum = 0.;
    for (std::size_t i = 0; i < law.size(); ++i)
      sum += dot(equations[i].residual, equations[i].residual) / (rho[i] * rho[i]);
    return sum;
  }

  double ContactSolver::residual(const Unknowns &force, const Unknowns &gap)
  {
    double f = 0., p = 0., q = 0., u = 0.;
    for (std::size_t i = 0; i < law.size(); ++i)
    {
      const Vector3 g = shifted_gap(i, force, gap), s = (*past)[i].start, r = get(force, i);
      const Vector3 e = law[i]->error(r, g, (*past)[i], mean_rho);
      f += dot(e, e);
      p += dot(r, r);
      for (unsigned int c = 0; c < 3; ++c) // friction only knows the displacement of the step
      {
        const double before = c == 0 || law[i]->is_tangentially_tied() ? 0. : s[c];
        q += ((*b)[3 * i + c] - before) * ((*b)[3 * i + c] - before);
        u += (g[c] - before) * (g[c] - before);
      }
    }
    // Where slip is a small part of the gap, no better than the round-off of the gap can be asked.
    const double force_size = std::sqrt(p), load_size = mean_rho * std::sqrt(q),
                 round_off = 1e-15 * mean_rho * std::sqrt(norm_square(*past));
    scale = std::max({force_size, load_size, mean_rho * std::sqrt(u), round_off / parameters.tolerance});
    // A singular step leaves forces without bound, which would make any error look small.
    if (!std::isfinite(f + scale) || force_size > 1e8 * (load_size + round_off))
      return std::numeric_limits<double>::infinity();
    return scale > 0. ? std::sqrt(f) / scale : 0.;
  }

  /** gap = W force + b, free of the round-off of updates; the last product is kept for the next step. */
  void ContactSolver::refresh_gap(const Unknowns &force, Unknowns &gap)
  {
    if (multiplied != force || product.empty())
    {
      W.multiply(force, product);
      multiplied = force;
    }
    gap = product;
    drift = 0.;
    add(gap, 1., *b);
  }

  double ContactSolver::remember(const Unknowns &force, const Unknowns &gap)
  {
    const double r = residual(force, gap);
    if (r < best.residual)
      best = {r, force};
    return r;
  }

  bool ContactSolver::out_of_time() const
  {
    return wall_time() > deadline;
  }

  unsigned int ContactSolver::steps_left() const
  {
    return parameters.max_iterations - std::min(parameters.max_iterations, result.iterations);
  }

  void ContactSolver::sweep(const unsigned int count, Unknowns &force, Unknowns &gap)
  {
    const auto solve_pair = [this](const unsigned int pair, const Matrix3 &H, const Vector3 &free)
    { return law[pair]->solve(H, free, (*past)[pair]); };
    for (unsigned int i = 0; i < count && !out_of_time(); ++i, ++result.sweeps)
      W.sweep(solve_pair, force, gap);
    drift += 1e-6;
  }

  /** Moves along @p step; returns by how much of it. None decreases: the whole step is taken. */
  double ContactSolver::line_search(const double bound, const Unknowns &step, const Unknowns &d_gap,
                                    Unknowns &force, Unknowns &gap)
  {
    Unknowns trial_force, trial_gap;
    for (unsigned int halving = 0; halving <= 12; ++halving)
    {
      const double t = halving == 12 ? 1. : std::ldexp(1., -static_cast<int>(halving));
      trial_force = force;
      trial_gap = gap;
      add(trial_force, t, step);
      add(trial_gap, t, d_gap);
      evaluate(trial_force, trial_gap);
      if (merit() <= (1. - 2e-4 * t) * bound || halving == 12)
      {
        force.swap(trial_force);
        gap.swap(trial_gap);
        return t;
      }
    }
    return 1.;
  }

  /** The residual, free of the round-off of single precision where that matters. */
  double ContactSolver::checked_residual(const double target, const Unknowns &force, Unknowns &gap)
  {
    const double now = residual(force, gap);
    if (drift == 0. || (now > target && drift <= .1 * now))
      return now;
    refresh_gap(force, gap);
    evaluate(force, gap);
    return residual(force, gap);
  }

  /** How exact the linear solver must be: as Newton is about to become (Eisenstat and Walker 1996, choice 2),
   *  but not looser than 1e-3 when it stalls: a loose step misses the soft modes of bodies that only their
   *  neighbours hold. */
  double ContactSolver::forcing_term(const double now, const double previous, const double target,
                                     const bool stalls) const
  {
    const double ratio = now / previous, loosest = stalls ? 1e-3 : .1;
    return std::clamp(.9 * ratio * ratio, std::min(loosest, .3 * target / now), loosest);
  }

  /** Newton's method from @p force for the present (regularised) problem. False when it stalls; @p force is
   *  then the best that was found. */
  bool ContactSolver::newton(const double target, const unsigned int max_steps, Unknowns &force,
                             Unknowns &gap)
  {
    evaluate(force, gap);
    double             now = checked_residual(target, force, gap), previous = now;
    Best               found{now, force};
    std::deque<double> merits(1, merit());
    Unknowns           step, d_gap;
    unsigned int       stalled = 0;
    for (unsigned int k = 0; now > target && k < max_steps && steps_left() > 0 && !out_of_time(); ++k)
    {
      if (proximal.alpha > 0.) // d gap/d force = W + alpha D
        for (std::size_t i = 0; i < law.size(); ++i)
          for (unsigned int c = 0; c < 9; ++c)
            equations[i].d_force[c] += proximal.alpha / rho[i] * equations[i].d_gap[c];
      result.factorisations += jacobian->update(equations);
      result.krylov += jacobian->solve(forcing_term(now, previous, target, stalled > 0), step, d_gap);
      ++result.iterations;
      // Nonmonotone, until it cycles.
      const double bound = stalled > 2 ? merits.back() : *std::max_element(merits.begin(), merits.end());
      const double t = line_search(bound, step, d_gap, force, gap);
      previous = now;
      if (!std::isfinite(residual(force, gap))) // singular
        break;
      drift += 1e-6 * t * mean_rho * std::sqrt(norm_square(d_gap)) / scale;
      now = checked_residual(target, force, gap);
      merits.push_back(merit());
      if (merits.size() > 5)
        merits.pop_front();
      stalled = now < .9 * found.residual ? 0 : stalled + 1;
      if (now < found.residual)
        found = {now, force};
      if (stalled == 15)
        break;
    }
    if (now <= target)
      return true;
    force = found.force;
    refresh_gap(force, gap);
    evaluate(force, gap);
    return false;
  }

  /** Regularised problems around the last solution; superlinear, since alpha falls with the residual. */
  bool ContactSolver::proximal_point(Unknowns &force, Unknowns &gap)
  {
    const auto here = [&]
    {
      proximal.alpha = 0.;
      return remember(force, gap);
    };
    double       now = here(), boost = 1.;
    unsigned int failures = 0, n_sweeps = 20;
    while (now > parameters.tolerance && steps_left() > 0 && !out_of_time())
    {
      proximal.centre = force;
      proximal.alpha = std::min(1., 5. * now) * boost;
      if (newton(std::max(.1 * now, .3 * parameters.tolerance), 50, force, gap))
        boost = std::max(1., .1 * boost);
      else
      {
        boost *= 10.;
        if (++failures == 4 && steps_left() > 0)
        {
          force = best.force;
          refresh_gap(force, gap);
          sweep(n_sweeps, force, gap);
          refresh_gap(force, gap);
          n_sweeps = std::min(2 * n_sweeps, 2000u);
          failures = 0;
          boost = 1.;
        }
      }
      now = here();
    }
    return now <= parameters.tolerance;
  }

  ContactResult ContactSolver::solve(const Unknowns &right_hand_side, const Unknowns &start, Unknowns &force,
                                     Unknowns &gap)
  {
    std::vector<PairPast> pairs;
    for (std::size_t i = 0; i < law.size(); ++i)
      pairs.emplace_back(get(start, i));
    return solve(right_hand_side, pairs, force, gap);
  }

  ContactResult ContactSolver::solve(const Unknowns &right_hand_side, const std::vector<PairPast> &pairs,
                                     Unknowns &force, Unknowns &gap)
  {
    b = &right_hand_side;
    past = &pairs;
    result = ContactResult();
    proximal.alpha = 0.;
    best = Best();
    deadline = wall_time() + parameters.max_seconds;

    if (!is_finite(force))
      force.assign(force.size(), 0.);
    refresh_gap(force, gap);
    const bool defined = is_finite(*b) && std::isfinite(norm_square(*past));
    if (defined)
    {
      best = {residual(force, gap), force};
      // Nothing touches? Newton comes close to zero forces only, which is not enough where b is zero, too.
      const Unknowns none(force.size(), 0.);
      if (best.residual > parameters.tolerance && residual(none, *b) <= parameters.tolerance)
      {
        force = none;
        gap = *b;
        best = {residual(force, gap), force};
      }
      evaluate(force, gap);
    }
    result.converged = !defined || best.residual <= parameters.tolerance; // looked at again below
    if (!result.converged && parameters.method == "newton")
    {
      sweep(parameters.sweeps, force, gap);
      result.converged = newton(parameters.tolerance, steps_left(), force, gap);
      remember(force, gap);
      if (!result.converged)
      {
        result.path = ContactPath::sweeps;
        sweep(20, force, gap);
        result.converged = newton(parameters.tolerance, steps_left(), force, gap);
        remember(force, gap);
      }
    }
    if (!result.converged && parameters.method == "sweeps")
    {
      result.path = ContactPath::sweeps;
      while (!result.converged && !out_of_time() &&
             result.sweeps < 1000 * std::size_t(parameters.max_iterations))
      {
        sweep(10, force, gap);
        refresh_gap(force, gap);
        result.converged = remember(force, gap) <= parameters.tolerance;
      }
    }
    else if (!result.converged)
    {
      result.path = ContactPath::proximal;
      if (parameters.method == "proximal")
        sweep(parameters.sweeps, force, gap);
      result.converged = proximal_point(force, gap);
    }
    if (!result.converged && best.residual < std::numeric_limits<double>::infinity())
      force = best.force;
    proximal.alpha = 0.;
    refresh_gap(force, gap);
    evaluate(force, gap);
    result.residual = residual(force, gap);
    result.converged = result.residual <= parameters.tolerance;
    for (std::size_t i = 0; i < law.size(); ++i)
    {
      state[i] = equations[i].state;
      touch[i] = equations[i].touching;
    }
    return result;
  }
} // namespace Voussoir
