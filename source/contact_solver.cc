#include <deal.II/base/parameter_handler.h>

#include <voussoir/contact_solver.h>
#include <voussoir/error.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>

namespace Voussoir
{
  namespace
  {
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

  ContactSolver::ContactSolver(const InterfaceOperator &W, std::vector<const JointLaw *> laws,
                               const ContactParameters &parameters)
      : W(W), law(std::move(laws)), parameters(parameters), jacobian(W), equations(law.size()),
        state(law.size(), PairState::open)
  {
    for (std::size_t i = 0; i < law.size(); ++i)
    {
      pair_W.push_back(W.diagonal(i));
      rho.push_back(1. / largest_eigenvalue(pair_W.back()));
    }
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

  /** One Gauss-Seidel sweep over all pairs with the exact solution of each; gap stays W force + b. */
  void ContactSolver::sweep(Unknowns &force, Unknowns &gap) const
  {
    for (const auto &colour : jacobian.colours())
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
          const Matrix3     &H = pair_W[pair];
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
      result.factorisations += jacobian.update(equations);
      // As exact as Newton is about to become (Eisenstat and Walker 1996, choice 2), but not looser than 1e-3
      // when it stalls: a loose step misses the soft modes of bodies that only their neighbours hold.
      const double ratio = result.iterations == 0 ? 1. : result.residual / previous;
      const double loosest = since_best > 0 ? 1e-3 : .1;
      const double tolerance = std::clamp(
          .9 * ratio * ratio, std::min(loosest, .3 * parameters.tolerance / result.residual), loosest);
      result.krylov += jacobian.solve(tolerance, step);
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
