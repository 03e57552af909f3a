// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/parallel.h>
#include <voussoir/contact/contact_solver.h>

#include <algorithm>
#include <cmath>
#include <deque>

namespace Voussoir
{
  namespace
  {
    constexpr std::size_t no_surfaces = std::numeric_limits<std::size_t>::max();

    void add_times(Unknowns &y, const double factor, const Unknowns &x)
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

    /** Returns the squared norm of the gaps at the start of the step. */
    double norm_square(const std::vector<PairHistory> &history)
    {
      double sum = 0.;
      for (const PairHistory &pair : history)
        for (const double y : pair.start)
          sum += y * y;
      return sum;
    }

    /** Returns the largest eigenvalue of the symmetric part of a positive definite 3x3 matrix, by the power
     * method with squaring. */
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

    /** Returns an estimate of the 2-norm of W [m/N] by power iteration. */
    double norm(const ContactOperator &W)
    {
      Unknowns x(3 * std::size_t(W.n_pairs())), y;
      for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = 1. + .5 * std::sin(double(i));
      double result = 0.;
      for (unsigned int i = 0; i < 6; ++i)
      {
        const double size = std::sqrt(norm_square(x));
        if (!(size > 0.) || !std::isfinite(size))
          break;
        W.multiply(x, y);
        result = std::sqrt(norm_square(y)) / size;
        x.swap(y);
      }
      return result;
    }
  } // namespace

  ContactSolver::ContactSolver(const ContactOperator &W, std::vector<const JointLaw *> laws,
                               const ContactParameters &parameters)
      : W(W), law(std::move(laws)), parameters(parameters), jacobian(W.make_jacobian()),
        equations(law.size()), state(law.size(), PairState::open), active(law.size(), 0)
  {
    double trace = 0.;
    for (std::size_t i = 0; i < law.size(); ++i)
    {
      const Matrix3 H = W.diagonal(i);
      trace += H[0] + H[4] + H[8];
      const double largest = largest_eigenvalue(H);
      rho.push_back(largest > 0. ? 1. / largest : 0.);
    }
    std::size_t begin = 0;
    for (std::size_t i = 0; i < law.size(); ++i)
    {
      number.push_back(no_surfaces);
      secondary_of_pair.push_back(begin);
      if (const SurfacesLaw *surfaces = law[i]->surfaces_law())
      {
        number.back() = with_surfaces.size();
        with_surfaces.push_back({i, begin, surfaces, {}});
        begin += 3 * surfaces->n_secondary();
      }
    }
    secondary_of_pair.push_back(begin);
    mean_rho = trace > 0. ? 3. * law.size() / trace : 1.;
    for (double &r : rho)
      if (!(r > 0.))
        r = mean_rho;
    norm_of_W = norm(W);
  }

  ContactSolver::~ContactSolver() = default;

  Vector3 ContactSolver::shifted_gap(const std::size_t i, const Iterate &x) const
  {
    Vector3 g = get(x.gap, i);
    if (proximal.alpha > 0. && number[i] == no_surfaces) // included in PairSurfaces
      for (unsigned int c = 0; c < 3; ++c)
        g[c] += proximal.alpha / rho[i] * (x.force[3 * i + c] - proximal.centre[3 * i + c]);
    return g;
  }

  void ContactSolver::evaluate(const Iterate &x)
  {
    of_pair.assign(law.size(), 0.);
    for_each_in_chunks(law.size(),
                       [&](const std::size_t i)
                       {
                         if (number[i] == no_surfaces)
                         {
                           law[i]->evaluate(get(x.force, i), shifted_gap(i, x), (*history)[i], rho[i],
                                            equations[i]);
                           return;
                         }
                         WithSurfaces &pair = with_surfaces[number[i]];
                         of_pair[i] = pair.surfaces.evaluate(get(x.force, i), shifted_gap(i, x),
                                                             x.secondary.data() + pair.begin, equations[i]) /
                                      (rho[i] * rho[i]);
                       });
    secondary_merit = 0.;
    for (const WithSurfaces &pair : with_surfaces)
      secondary_merit += of_pair[pair.pair];
  }

  double ContactSolver::merit() const
  {
    double sum = secondary_merit;
    for (std::size_t i = 0; i < law.size(); ++i)
      sum += dot(equations[i].residual, equations[i].residual) / (rho[i] * rho[i]);
    return sum;
  }

  /** Computes the relative residual. @p rigid: without the artificial compliance of rigid flanks. */
  double ContactSolver::residual(const Iterate &x, const bool rigid)
  {
    of_pair.assign(law.size(), 0.);
    for_each_in_chunks(law.size(),
                       [&](const std::size_t i)
                       {
                         const Vector3 g = shifted_gap(i, x), r = get(x.force, i);
                         if (number[i] == no_surfaces)
                         {
                           const Vector3 e = law[i]->error(r, g, (*history)[i], mean_rho);
                           of_pair[i] = dot(e, e);
                           return;
                         }
                         const WithSurfaces &pair = with_surfaces[number[i]];
                         of_pair[i] = pair.surfaces.error_square(r, g, x.secondary.data() + pair.begin,
                                                                 mean_rho, rigid);
                       });
    double f = 0., p = 0., q = 0., u = 0.;
    for (std::size_t i = 0; i < law.size(); ++i)
    {
      const Vector3 g = shifted_gap(i, x), s = (*history)[i].start, r = get(x.force, i);
      f += of_pair[i];
      p += dot(r, r);
      for (unsigned int c = 0; c < 3; ++c) // friction depends on the displacement of the step only
      {
        const double before = c == 0 || law[i]->is_tangentially_tied() ? 0. : s[c];
        q += ((*b)[3 * i + c] - before) * ((*b)[3 * i + c] - before);
        u += (g[c] - before) * (g[c] - before);
      }
    }
    // If slip is a small part of the gap, the round-off of the gap limits the accuracy.
    const double force_size = std::sqrt(p), load_size = mean_rho * std::sqrt(q), error = std::sqrt(f),
                 round_off = 1e-15 * mean_rho * std::sqrt(norm_square(*history));
    scale = std::max({force_size, load_size, mean_rho * std::sqrt(u), round_off / parameters.tolerance});
    result.force_over_load = load_size > 0. ? force_size / load_size : 0.;
    result.residual = scale > 0. ? error / scale : 0.;
    result.residual_over_load = load_size > 0. ? error / load_size : result.residual;
    if (!std::isfinite(f + scale) || force_size > 1e7 * (load_size + round_off))
      return std::numeric_limits<double>::infinity();
    // Unbounded forces (a problem without a solution, a singular step) make any error small relative to
    // the forces. The error must therefore be small relative to the load, too. The round-off of W force
    // is allowed, for forces up to 1e2 loads. With larger forces, an overlap of 1e-12 of the load would
    // count as round-off.
    const double allowance = 4. * std::numeric_limits<double>::epsilon() * norm_of_W * mean_rho *
                             std::min(force_size, 1e2 * load_size);
    scale = std::min(scale, std::max(load_size, (allowance + round_off) / parameters.tolerance));
    return scale > 0. ? error / scale : 0.;
  }

  /** Computes gap = W force + b without the round-off of updates. Keeps the product for the next step. */
  void ContactSolver::refresh_gap(Iterate &x)
  {
    if (multiplied != x.force || product.empty())
    {
      W.multiply(x.force, product);
      multiplied = x.force;
    }
    x.gap = product;
    drift = 0.;
    add_times(x.gap, 1., *b);
  }

  void ContactSolver::set_force(Iterate &x, const Best &from)
  {
    x.force = from.force;
    x.secondary = from.secondary;
    refresh_gap(x);
  }

  double ContactSolver::remember(const Iterate &x)
  {
    const double r = residual(x);
    if (r < best.residual)
      best = {r, x.force, x.secondary};
    return r;
  }

  unsigned int ContactSolver::steps_left() const
  {
    return parameters.max_iterations - std::min(parameters.max_iterations, result.iterations);
  }

  void ContactSolver::sweep(const unsigned int count, Iterate &x)
  {
    const double accuracy = parameters.method == "sweeps" ? 1e-14 : 1e-6; // Newton's method follows
    const auto   solve_pair = [&](const unsigned int pair, const Matrix3 &H, const Vector3 &free)
    {
      if (number[pair] == no_surfaces)
        return law[pair]->solve(H, free, (*history)[pair]);
      WithSurfaces &with = with_surfaces[number[pair]];
      return with.surfaces.solve(H, free, accuracy, get(x.force, pair), x.secondary.data() + with.begin);
    };
    for (unsigned int i = 0; i < count && !out_of_time(); ++i, ++result.sweeps)
    {
      W.sweep(solve_pair, x.force, x.gap);
      W.gather_pairs(x.secondary, secondary_of_pair);
    }
    drift += 1e-6;
    if (!W.is_in_blocks() && count > 0)
      refresh_gap(x);
  }

  /** Moves @p x along @p step and returns the fraction used. If no fraction decreases the merit function, the
   * whole step is used. */
  double ContactSolver::line_search(const double bound, const Iterate &step, Iterate &x)
  {
    Iterate trial;
    for (unsigned int halving = 0; halving <= 12; ++halving)
    {
      const double t = halving == 12 ? 1. : std::ldexp(1., -static_cast<int>(halving));
      trial = x;
      add_times(trial.force, t, step.force);
      add_times(trial.gap, t, step.gap);
      add_times(trial.secondary, t, step.secondary);
      evaluate(trial);
      if (merit() <= (1. - 2e-4 * t) * bound || halving == 12)
      {
        std::swap(x, trial);
        return t;
      }
    }
    return 1.;
  }

  /** Returns the residual @p now. Recomputes it without the round-off of single precision if necessary. */
  double ContactSolver::checked_residual(const double target, const double now, Iterate &x)
  {
    if (drift == 0. || (now > target && drift <= .1 * now))
      return now;
    refresh_gap(x);
    evaluate(x);
    return residual(x);
  }

  /** Returns the tolerance of the linear solver: that of Eisenstat and Walker (1996), choice 2, but at most
   * 1e-3 if Newton stalls. A loose tolerance does not resolve the soft modes of bodies that are supported by
   * their neighbours only. */
  double ContactSolver::forcing_term(const double now, const double previous, const double target,
                                     const bool stalls) const
  {
    const double ratio = now / previous, loosest = stalls ? 1e-3 : .1;
    return std::clamp(.9 * ratio * ratio, std::min(loosest, .3 * target / now), loosest);
  }

  /** Performs a Newton step with the equations of the last evaluate(). @p bound: upper limit of the merit
   * function. Returns the increase of @p drift times the scale. */
  double ContactSolver::newton_step(const double forcing, const double bound, Iterate &x)
  {
    for_each_in_chunks(with_surfaces.size(), [&](const std::size_t i)
                       { with_surfaces[i].surfaces.condense(equations[with_surfaces[i].pair]); });
    if (proximal.alpha > 0.) // d gap/d force = W + alpha D
      for (std::size_t i = 0; i < law.size(); ++i)
        for (unsigned int c = 0; c < 9 && number[i] == no_surfaces; ++c)
          equations[i].d_force[c] += proximal.alpha / rho[i] * equations[i].d_gap[c];
    Iterate step;
    result.factorisations += jacobian->update(equations);
    result.krylov += jacobian->solve(forcing, step.force, step.gap);
    ++result.iterations;
    step.secondary.resize(x.secondary.size());
    for_each_in_chunks(with_surfaces.size(),
                       [&](const std::size_t i)
                       {
                         const WithSurfaces &pair = with_surfaces[i];
                         pair.surfaces.expand(equations[pair.pair], get(step.force, pair.pair),
                                              get(step.gap, pair.pair), step.secondary.data() + pair.begin);
                       });
    const double t = line_search(bound, step, x);
    return 1e-6 * t * mean_rho * std::sqrt(norm_square(step.gap));
  }

  /** Performs Newton's method from @p x for the present (regularised) problem. Returns false if it stalls for
   * @p patience steps; @p x is then the best iterate. */
  bool ContactSolver::newton(const double target, const unsigned int max_steps, const unsigned int patience,
                             Iterate &x)
  {
    evaluate(x);
    double             now = checked_residual(target, residual(x), x), previous = now;
    Best               found{now, x.force, x.secondary};
    std::deque<double> merits(1, merit());
    unsigned int       stalled = 0;
    for (unsigned int k = 0; now > target && k < max_steps && steps_left() > 0 && !out_of_time(); ++k)
    {
      // The line search is nonmonotone unless Newton cycles.
      const double bound = stalled > 2 ? merits.back() : *std::max_element(merits.begin(), merits.end());
      const double moved = newton_step(forcing_term(now, previous, target, stalled > 0), bound, x);
      previous = now;
      const double reached = residual(x);
      if (!std::isfinite(reached)) // singular matrix
        break;
      drift += moved / scale;
      now = checked_residual(target, reached, x);
      merits.push_back(merit());
      if (merits.size() > 5)
        merits.pop_front();
      stalled = now < .9 * found.residual ? 0 : stalled + 1;
      if (now < found.residual)
        found = {now, x.force, x.secondary};
      if (stalled == patience)
        break;
    }
    if (now <= target)
      return true;
    set_force(x, found);
    evaluate(x);
    return false;
  }
} // namespace Voussoir
