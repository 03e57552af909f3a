#include <deal.II/base/parameter_handler.h>

#include <voussoir/contact_solver.h>
#include <voussoir/error.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>

extern "C"
{
  void dgetrf_(const int *, const int *, double *, const int *, int *, int *);
  void dgetrs_(const char *, const int *, const int *, const double *, const int *, const int *, double *,
               const int *, int *);
}

namespace Voussoir
{
  namespace
  {
    double dot(const Unknowns &a, const Unknowns &b)
    {
      return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
    }

    double norm(const Unknowns &a)
    {
      return std::sqrt(dot(a, a));
    }

    void add(Unknowns &y, const double factor, const Unknowns &x)
    {
      for (std::size_t i = 0; i < y.size(); ++i)
        y[i] += factor * x[i];
    }

    /** Largest eigenvalue of a symmetric positive definite 3x3 matrix, by the power method with squaring. */
    double largest_eigenvalue(Matrix3 a)
    {
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

    bool row_is_trivial(const PairEquations &e, const unsigned int i)
    {
      for (unsigned int j = 0; j < 3; ++j)
        if (e.d_gap[3 * i + j] != 0. || e.d_force[3 * i + j] != (i == j ? 1. : 0.))
          return false;
      return true;
    }
  } // namespace

  void ContactParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Double;
    using dealii::Patterns::Integer;
    prm.enter_subsection("Contact");
    prm.add_parameter(
        "Tolerance", tolerance,
        "Relative residual of the joint conditions at which a step is accepted; independent of units [-].",
        Double(1e-15, 1e-3));
    prm.add_parameter("Maximum iterations", max_iterations, "Newton steps before the solver gives up [-].",
                      Integer(1));
    prm.add_parameter("Sweeps", sweeps, "Gauss-Seidel sweeps before the first Newton step [-].", Integer(0));
    prm.leave_subsection();
  }

  void ContactParameters::check() const {}

  ContactSolver::ContactSolver(const InterfaceOperator &W, std::vector<const JointLaw *> laws,
                               const ContactParameters &parameters)
      : W(W), law(std::move(laws)), parameters(parameters), rho(law.size()), equations(law.size()),
        factorised(law.size()), state(law.size(), PairState::open), factors(W.n_groups()),
        colour_of(W.n_groups(), 0)
  {
    for (std::size_t i = 0; i < law.size(); ++i)
      rho[i] = 1. / largest_eigenvalue(W.diagonal(i));
    for (unsigned int g = 0; g < W.n_groups(); ++g)
    {
      std::vector<bool> taken(W.n_groups() + 1, false);
      for (const unsigned int k : W.neighbours(g))
        if (k < g)
          taken[colour_of[k]] = true;
      colour_of[g] = std::find(taken.begin(), taken.end(), false) - taken.begin();
      colours.resize(std::max<std::size_t>(colours.size(), colour_of[g] + 1));
      colours[colour_of[g]].push_back(g);
    }
    for (PairEquations &e : factorised)
      e.d_gap[0] = std::nan(""); // equal to nothing: all joints are factorised at first use
  }

  void ContactSolver::evaluate(const Unknowns &force, const Unknowns &gap)
  {
    for (std::size_t i = 0; i < law.size(); ++i)
      state[i] = law[i]->evaluate({{force[3 * i], force[3 * i + 1], force[3 * i + 2]}},
                                  {{gap[3 * i], gap[3 * i + 1], gap[3 * i + 2]}}, rho[i], equations[i]);
  }

  double ContactSolver::merit() const
  {
    double sum = 0.;
    for (std::size_t i = 0; i < law.size(); ++i)
      for (const double f : equations[i].residual)
        sum += f * f / (rho[i] * rho[i]);
    return sum;
  }

  double ContactSolver::relative_residual(const Unknowns &b, const Unknowns &force) const
  {
    double f = 0., p = 0., q = 0.;
    for (std::size_t i = 0; i < law.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
      {
        f += equations[i].residual[c] * equations[i].residual[c];
        p += force[3 * i + c] * force[3 * i + c];
        q += rho[i] * rho[i] * b[3 * i + c] * b[3 * i + c];
      }
    const double scale = std::max(p, q);
    return scale > 0. ? std::sqrt(f / scale) : 0.;
  }

  /** Factorise the diagonal blocks of d_force + d_gap W, without their trivial rows, where something changed.
   */
  unsigned int ContactSolver::factorise()
  {
    unsigned int count = 0;
#pragma omp parallel for schedule(dynamic) reduction(+ : count)
    for (int g = 0; g < static_cast<int>(W.n_groups()); ++g)
    {
      const unsigned int first = W.begin(g) / 3, n_pairs = W.size(g) / 3;
      bool               same = true;
      for (unsigned int i = first; i < first + n_pairs && same; ++i)
        same = equations[i].d_force == factorised[i].d_force && equations[i].d_gap == factorised[i].d_gap;
      if (same || n_pairs == 0)
        continue;
      std::copy(equations.begin() + first, equations.begin() + first + n_pairs, factorised.begin() + first);
      GroupFactor &factor = factors[g];
      factor.active.clear();
      for (unsigned int i = 0; i < n_pairs; ++i)
        for (unsigned int c = 0; c < 3; ++c)
          if (!row_is_trivial(equations[first + i], c))
            factor.active.push_back(3 * i + c);
      const std::vector<double> &w = W.block(g, g);
      const int                  n = factor.active.size(), ld = W.size(g);
      factor.lu.resize(std::size_t(n) * n);
      factor.pivots.resize(n);
      for (int column = 0; column < n; ++column)
      {
        const unsigned int k = factor.active[column];
        const double      *w_k = w.data() + std::size_t(k) * ld;
        double            *out = factor.lu.data() + std::size_t(column) * n;
        for (int row = 0; row < n; ++row)
        {
          const unsigned int   j = factor.active[row], pair = j / 3, c = 3 * (j % 3);
          const PairEquations &e = equations[first + pair];
          out[row] = e.d_gap[c] * w_k[3 * pair] + e.d_gap[c + 1] * w_k[3 * pair + 1] +
                     e.d_gap[c + 2] * w_k[3 * pair + 2] + (k / 3 == pair ? e.d_force[c + k % 3] : 0.);
        }
      }
      int info = 0;
      if (n > 0)
        dgetrf_(&n, &n, factor.lu.data(), &n, factor.pivots.data(), &info);
      ++count;
    }
    return count;
  }

  /** x <- (diagonal block of the group)^-1 x; trivial rows stay as they are. */
  void ContactSolver::apply(const unsigned int group, double *x) const
  {
    const GroupFactor  &factor = factors[group];
    const int           n = factor.active.size(), one = 1;
    std::vector<double> z(n);
    int                 info = 0;
    for (int i = 0; i < n; ++i)
      z[i] = x[factor.active[i]];
    if (n > 0)
      dgetrs_("N", &n, &one, factor.lu.data(), &n, factor.pivots.data(), z.data(), &n, &info);
    for (int i = 0; i < n; ++i)
      x[factor.active[i]] = z[i];
  }

  /** v_j += d_gap sum_k W_jk z_k over the neighbours of later (or earlier) colour. */
  void ContactSolver::couple(const Unknowns &z, Unknowns &v, const unsigned int j, const bool to_later) const
  {
    const double        sign = to_later ? 1. : -1.;
    std::vector<double> w(W.size(j), 0.);
    for (const unsigned int k : W.neighbours(j))
      if ((colour_of[k] > colour_of[j]) == to_later)
        W.add_coupling(j, k, sign, z.data() + W.begin(k), w.data());
    for (unsigned int i = 0; i < W.size(j) / 3; ++i)
    {
      const Vector3 x = equations[W.begin(j) / 3 + i].d_gap * Vector3{{w[3 * i], w[3 * i + 1], w[3 * i + 2]}};
      for (unsigned int c = 0; c < 3; ++c)
        v[W.begin(j) + 3 * i + c] += x[c];
    }
  }

  /** step = -J^-1 residual by right-preconditioned GMRES. With the Gauss-Seidel preconditioner P = D + L (D:
   * joints, L: couplings to earlier colours) and J = D + L + U, a product is J P^-1 v = v + U P^-1 v. */
  unsigned int ContactSolver::solve_linear(const double tolerance, Unknowns &step)
  {
    const unsigned int n = W.n(), max_krylov = 200;
    const auto         precondition = [&](const Unknowns &v)
    {
      Unknowns z = v;
      for (const auto &colour : colours)
#pragma omp parallel for schedule(dynamic)
        for (int i = 0; i < static_cast<int>(colour.size()); ++i)
        {
          couple(z, z, colour[i], false);
          apply(colour[i], z.data() + W.begin(colour[i]));
        }
      return z;
    };
    const auto multiply = [&](const Unknowns &v, const Unknowns &z)
    {
      Unknowns w = v;
#pragma omp parallel for schedule(dynamic)
      for (int g = 0; g < static_cast<int>(W.n_groups()); ++g)
        couple(z, w, g, true);
      return w;
    };

    // The trivial rows first: exact, and zero for ever after.
    Unknowns r(n), trivial(n, 0.);
    double   trivial_sum = 0.;
    for (std::size_t i = 0; i < law.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
      {
        r[3 * i + c] = -equations[i].residual[c];
        if (row_is_trivial(equations[i], c))
        {
          trivial[3 * i + c] = r[3 * i + c];
          trivial_sum += std::abs(r[3 * i + c]);
        }
      }
    const double target = tolerance * norm(r);
    step = trivial;
    if (trivial_sum > 0.)
    {
      Unknowns w;
      W.multiply(trivial, w);
      for (std::size_t i = 0; i < law.size(); ++i)
      {
        const Vector3 f = equations[i].d_force *
                          Vector3{{trivial[3 * i], trivial[3 * i + 1], trivial[3 * i + 2]}},
                      g = equations[i].d_gap * Vector3{{w[3 * i], w[3 * i + 1], w[3 * i + 2]}};
        for (unsigned int c = 0; c < 3; ++c)
          r[3 * i + c] -= f[c] + g[c];
      }
    }

    std::vector<Unknowns>            v, z;
    std::vector<std::vector<double>> h; // columns of the Hessenberg matrix, made triangular by rotations
    std::vector<double>              cosine, sine, g(1, norm(r));
    if (g[0] <= target || g[0] == 0.)
      return 0;
    v.push_back(r);
    for (double &x : v[0])
      x /= g[0];
    unsigned int k = 0;
    for (; k < max_krylov && std::abs(g[k]) > target; ++k)
    {
      z.push_back(precondition(v[k]));
      Unknowns            w = multiply(v[k], z[k]);
      std::vector<double> column(k + 2);
      for (unsigned int i = 0; i <= k; ++i)
      {
        column[i] = dot(v[i], w);
        add(w, -column[i], v[i]);
      }
      column[k + 1] = norm(w);
      const double next = column[k + 1];
      for (unsigned int i = 0; i < k; ++i)
      {
        const double t = cosine[i] * column[i] + sine[i] * column[i + 1];
        column[i + 1] = -sine[i] * column[i] + cosine[i] * column[i + 1];
        column[i] = t;
      }
      const double radius = std::hypot(column[k], column[k + 1]);
      if (!(radius > 0.))
        break;
      cosine.push_back(column[k] / radius);
      sine.push_back(column[k + 1] / radius);
      column[k] = radius;
      h.push_back(column);
      g.push_back(-sine[k] * g[k]);
      g[k] *= cosine[k];
      if (next == 0.)
      {
        ++k;
        break;
      }
      for (double &x : w)
        x /= next;
      v.push_back(std::move(w));
    }
    std::vector<double> y(k);
    for (unsigned int i = k; i-- > 0;)
    {
      y[i] = g[i];
      for (unsigned int j = i + 1; j < k; ++j)
        y[i] -= h[j][i] * y[j];
      y[i] /= h[i][i];
    }
    for (unsigned int i = 0; i < k; ++i)
      add(step, y[i], z[i]);
    return k;
  }

  /** One Gauss-Seidel sweep over all pairs with the exact solution of each; gap stays W force + b. */
  void ContactSolver::sweep(Unknowns &force, Unknowns &gap) const
  {
    for (const auto &colour : colours)
    {
      std::vector<std::vector<double>> change(colour.size());
#pragma omp parallel for schedule(dynamic)
      for (int index = 0; index < static_cast<int>(colour.size()); ++index)
      {
        const unsigned int         j = colour[index], m = W.size(j);
        const std::vector<double> &w = W.block(j, j);
        change[index].assign(m, 0.);
        for (unsigned int i = 0; i < m; i += 3)
        {
          const unsigned int pair = (W.begin(j) + i) / 3;
          double            *f = &force[3 * pair], *d = &gap[W.begin(j)];
          const Matrix3      H = W.diagonal(pair);
          const Vector3      Hf = H * Vector3{{f[0], f[1], f[2]}};
          const Vector3      solution =
              law[pair]->solve(H, {{d[i] - Hf[0], d[i + 1] - Hf[1], d[i + 2] - Hf[2]}}, true);
          for (unsigned int c = 0; c < 3; ++c)
          {
            const double delta = solution[c] - f[c];
            f[c] = solution[c];
            change[index][i + c] = delta;
            const double *column = w.data() + std::size_t(i + c) * m;
            if (delta != 0.)
              for (unsigned int row = 0; row < m; ++row)
                d[row] += delta * column[row];
          }
        }
      }
      for (std::size_t index = 0; index < colour.size(); ++index)
        for (const unsigned int k : W.neighbours(colour[index]))
          W.add_coupling(k, colour[index], 1., change[index].data(), gap.data() + W.begin(k));
    }
  }

  ContactResult ContactSolver::solve(const Unknowns &b, Unknowns &force, Unknowns &gap)
  {
    ContactResult result;
    const auto    update_gap = [&]
    {
      W.multiply(force, gap);
      add(gap, 1., b);
    };
    update_gap();
    for (; result.sweeps < parameters.sweeps; ++result.sweeps)
      sweep(force, gap);
    evaluate(force, gap);
    result.residual = relative_residual(b, force);

    std::deque<double> merits(1, merit());
    double             previous = result.residual, best = result.residual;
    Unknowns           best_force = force, step, d_gap, trial_force, trial_gap;
    unsigned int       since_best = 0;
    while (result.residual > parameters.tolerance && result.iterations < parameters.max_iterations)
    {
      result.factorisations += factorise();
      // As exact as Newton is about to become (Eisenstat and Walker 1996, choice 2), but not looser than 1e-3
      // when it stalls: a loose step misses the soft modes of bodies that only their neighbours hold.
      const double ratio = result.iterations == 0 ? 1. : result.residual / previous;
      const double loosest = since_best > 0 ? 1e-3 : .1;
      const double tolerance = std::clamp(
          .9 * ratio * ratio, std::min(loosest, .3 * parameters.tolerance / result.residual), loosest);
      result.krylov += solve_linear(tolerance, step);
      W.multiply(step, d_gap);
      previous = result.residual;

      double       t = 1.;
      const double bound = *std::max_element(merits.begin(), merits.end());
      for (unsigned int halving = 0; halving <= 12; ++halving, t *= .5)
      {
        if (halving == 12) // none decreases: take the whole step, and remember the best
          t = 1.;
        trial_force = force;
        trial_gap = gap;
        add(trial_force, t, step);
        add(trial_gap, t, d_gap);
        evaluate(trial_force, trial_gap);
        if (merit() <= (1. - 2e-4 * t) * bound || halving == 12)
          break;
      }
      force.swap(trial_force);
      gap.swap(trial_gap);
      ++result.iterations;
      merits.push_back(merit());
      if (merits.size() > 5)
        merits.pop_front();
      result.residual = relative_residual(b, force);
      if (result.residual <= parameters.tolerance) // free of the round-off of the updates?
      {
        update_gap();
        evaluate(force, gap);
        result.residual = relative_residual(b, force);
      }
      if (!(result.residual < 1e30))
        break;
      since_best = result.residual < .9 * best ? 0 : since_best + 1;
      if (result.residual < best)
      {
        best = result.residual;
        best_force = force;
      }
      if (since_best == 15) // Newton stalls or cycles: settle the states pair by pair, then go on
      {
        force = best_force;
        update_gap();
        for (unsigned int i = 0; i < 20; ++i, ++result.sweeps)
          sweep(force, gap);
        evaluate(force, gap);
        result.residual = relative_residual(b, force);
        merits.assign(1, merit());
        since_best = 0;
        best = result.residual;
      }
    }
    result.converged = result.residual <= parameters.tolerance;
    if (!result.converged)
    {
      force = best_force;
      update_gap();
      evaluate(force, gap);
      result.residual = relative_residual(b, force);
    }
    return result;
  }
} // namespace Voussoir
