// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/parallel.h>
#include <voussoir/joints/dense_kernels.h>
#include <voussoir/joints/joint_jacobian.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Voussoir
{
  namespace
  {
    using Floats = std::vector<float>;
  } // namespace

  JointJacobian::JointJacobian(const InterfaceOperator &W) : W(W), joints(W.n_groups()), crossings(W)
  {
    for (unsigned int g = 0; g < W.n_groups(); ++g)
      for (unsigned int k = g; k < W.n_groups(); ++k)
        if (W.find_block(g, k) && W.size(g) > 0 && W.size(k) > 0)
        {
          if (W.holds(g, k))
            keys.push_back({g, k});
          is_chain = is_chain && k <= g + 1;
        }
    for_each_parallel(W.n_groups(),
                      [&](const int g)
                      {
                        if (W.is_mine(g))
                          joints[g].initialise(W, g);
                      });
  }

  void JointJacobian::begin()
  {
    use_chain = expects_chain;
    if (!use_chain)
      chain.reset();
    for (JointBlock &joint : joints)
      joint.forget();
  }

  unsigned int JointJacobian::update(const std::vector<PairEquations> &new_equations)
  {
    equations = &new_equations;
    has_chain = use_chain;
    if (has_chain)
    {
      if (!chain)
        chain = std::make_unique<JointChain>(W);
      if (expects_chain)
        joints.clear();
      chain->factorise(new_equations);
      return W.n_groups();
    }
    crossings.invert(new_equations);
    std::vector<unsigned int> made(W.n_groups(), 0);
    for_each_parallel(W.n_groups(), [&](const int g)
                      { made[g] = W.size(g) > 0 && W.is_mine(g) && joints[g].update(present(g)); });
    if (!W.shares().are_trivial())
    {
      std::vector<unsigned int> number(W.n_groups() + 1);
      std::iota(number.begin(), number.end(), 0);
      Ranks::gather(made.data(), W.shares().parts(number));
    }
    return std::accumulate(made.begin(), made.end(), 0u);
  }

  /** Computes y += factor d_gap x in the rows of a group. */
  void JointJacobian::multiply_by_d_gap(const unsigned int group, const float factor, const float *x,
                                        float *y) const
  {
    for (unsigned int i = 0; i < W.size(group) / 3; ++i)
    {
      const Vector3 g = present(group)[i].d_gap * Vector3{{x[3 * i], x[3 * i + 1], x[3 * i + 2]}};
      for (unsigned int c = 0; c < 3; ++c)
        y[3 * i + c] += factor * static_cast<float>(g[c]);
    }
  }

  /** Computes y = W x. Each block is used for both of its groups while it is in the cache. */
  void JointJacobian::multiply_W(const Floats &x, Floats &y) const
  {
    std::vector<std::array<Floats, 2>> products(keys.size());
    for_each_parallel(keys.size(),
                      [&](const int i)
                      {
                        const unsigned int j = keys[i].first, k = keys[i].second;
                        if (W.is_mine(j))
                        {
                          products[i][0].assign(W.size(j), 0.f);
                          W.add_single(j, k, x.data() + W.begin(k), products[i][0].data());
                        }
                        if (j != k && W.is_mine(k))
                        {
                          products[i][1].assign(W.size(k), 0.f);
                          W.add_single(k, j, x.data() + W.begin(j), products[i][1].data());
                        }
                      });
    y.assign(W.n(), 0.f);
    for (std::size_t i = 0; i < keys.size(); ++i)
      for (unsigned int side = 0; side < 2; ++side)
      {
        float *out = y.data() + W.begin(side == 0 ? keys[i].first : keys[i].second);
        for (const float p : products[i][side])
          *out++ += p;
      }
    W.gather(y);
  }

  /** Computes y = W x for an @p x with few nonzero entries. */
  void JointJacobian::multiply_W_sparse(const Unknowns &x, Floats &y) const
  {
    y.assign(W.n(), 0.f);
    const Floats x_single(x.begin(), x.end());
    for (unsigned int k = 0; k < W.n_groups(); ++k)
    {
      const float              *x_k = x_single.data() + W.begin(k);
      std::vector<unsigned int> entries;
      for (unsigned int i = 0; i < W.size(k); ++i)
        if (x_k[i] != 0.f)
          entries.push_back(i);
      if (entries.empty())
        continue;
      for (const unsigned int i : entries)
        if (W.is_mine(k))
          add(x_k[i], W.single_block(k).data() + std::size_t(i) * W.size(k), W.size(k),
              y.data() + W.begin(k));
      for (const unsigned int j : W.neighbours(k))
        if (W.is_mine(j))
          W.add_single(j, k, x_k, y.data() + W.begin(j));
    }
    W.gather(y);
  }

  /** Computes z = P^-1 v and W z. */
  void JointJacobian::precondition(const Floats &v, Floats &z, Floats &Wz) const
  {
    z = v;
    if (has_chain)
    {
      chain->solve(v, z);
      multiply_W(z, Wz);
      return;
    }
    Wz.assign(W.n(), 0.f);
    W.gauss_seidel(
        [&](const unsigned int g)
        {
          float *z_g = z.data() + W.begin(g), *Wz_g = Wz.data() + W.begin(g);
          Floats r(z_g, z_g + W.size(g)), own(W.size(g));
          multiply_by_d_gap(g, -1.f, Wz_g, r.data());
          joints[g].solve(r.data(), z_g, own.data());
          for (unsigned int j = 0; j < W.size(g); ++j)
            Wz_g[j] += own[j];
        },
        z, Wz);
    if (!crossings.is_empty())
      crossings.correct(*equations, v, z, Wz);
  }

  /** Computes w = J z. */
  void JointJacobian::multiply_J(const Floats &z, const Floats &Wz, Floats &w) const
  {
    w.resize(W.n());
    for (std::size_t i = 0; i < equations->size(); ++i)
    {
      const PairEquations &e = (*equations)[i];
      const float         *f = z.data() + 3 * i, *g = Wz.data() + 3 * i;
      for (unsigned int c = 0; c < 3; ++c)
      {
        const double *a = e.d_force.data() + 3 * c, *b = e.d_gap.data() + 3 * c;
        w[3 * i + c] = static_cast<float>(a[0] * f[0] + a[1] * f[1] + a[2] * f[2] + b[0] * g[0] +
                                          b[1] * g[1] + b[2] * g[2]);
      }
    }
  }

  unsigned int JointJacobian::solve(const double tolerance, Unknowns &step, Unknowns &d_gap)
  {
    if (W.is_in_blocks())
      return solve_blocks(tolerance, step, d_gap);
    const unsigned int iterations = solve_blocks(
        .5 * tolerance, step, d_gap); // the remaining tolerance is for couplings outside the blocks
    return iterations + correct(tolerance, step, d_gap);
  }

  /** Corrects a solution with the blocks until it satisfies the complete operator. The couplings by the base
   * nodes outside the blocks are small. */
  unsigned int JointJacobian::correct(const double tolerance, Unknowns &step, Unknowns &d_gap) const
  {
    constexpr unsigned int most = 10;
    unsigned int           iterations = 0;
    for (unsigned int round = 0; round < most; ++round)
    {
      W.multiply(step, d_gap);
      Unknowns r(W.n());
      double   all = 0., left = 0.;
      for (std::size_t i = 0; i < equations->size(); ++i)
      {
        const PairEquations &e = (*equations)[i];
        const Vector3        f = e.d_force * get(step, i), g = e.d_gap * get(d_gap, i);
        for (unsigned int c = 0; c < 3; ++c)
        {
          r[3 * i + c] = -e.residual[c] - f[c] - g[c];
          all += e.residual[c] * e.residual[c];
          left += r[3 * i + c] * r[3 * i + c];
        }
      }
      if (left <= std::max(tolerance * tolerance, 1e-12) * all || round + 1 == most)
        break;
      iterations += gmres(r, .5 * tolerance * std::sqrt(all), step, d_gap);
    }
    return iterations;
  }

  unsigned int JointJacobian::solve_blocks(const double tolerance, Unknowns &step, Unknowns &d_gap)
  {
    const unsigned int n = W.n();
    // Trivial rows first: their solution is exact and does not change.
    Unknowns r(n);
    bool     trivial = false;
    step.assign(n, 0.);
    double all = 0.;
    for (std::size_t i = 0; i < equations->size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const double f = (*equations)[i].residual[c];
        r[3 * i + c] = -f;
        all += f * f;
        if (f != 0. && row_is_trivial((*equations)[i], c))
        {
          step[3 * i + c] = -f;
          trivial = true;
        }
      }
    Floats w;
    if (trivial)
    {
      multiply_W_sparse(step, w);
      for (std::size_t i = 0; i < equations->size(); ++i)
      {
        const Vector3 f = (*equations)[i].d_force * Vector3{{step[3 * i], step[3 * i + 1], step[3 * i + 2]}},
                      g = (*equations)[i].d_gap * Vector3{{w[3 * i], w[3 * i + 1], w[3 * i + 2]}};
        for (unsigned int c = 0; c < 3; ++c)
          r[3 * i + c] -= f[c] + g[c];
      }
    }
    d_gap.assign(w.begin(), w.end());
    d_gap.resize(n);
    const unsigned int iterations = gmres(r, tolerance * std::sqrt(all), step, d_gap);
    if (iterations > 20)
      use_chain = is_chain; // from the next equations on
    return iterations;
  }

  namespace
  {
    /** Makes a column of the Hessenberg matrix triangular by the previous rotations and a new one, and
     * applies the new rotation to the right-hand side @p g. Returns false if the column is zero. */
    bool rotate(std::vector<double> &column, std::vector<double> &cosine, std::vector<double> &sine,
                std::vector<double> &g)
    {
      const std::size_t k = cosine.size();
      for (std::size_t i = 0; i < k; ++i)
      {
        const double t = cosine[i] * column[i] + sine[i] * column[i + 1];
        column[i + 1] = -sine[i] * column[i] + cosine[i] * column[i + 1];
        column[i] = t;
      }
      const double radius = std::hypot(column[k], column[k + 1]);
      if (!(radius > 0.) || !std::isfinite(radius))
        return false;
      cosine.push_back(column[k] / radius);
      sine.push_back(column[k + 1] / radius);
      column[k] = radius;
      g.push_back(-sine[k] * g[k]);
      g[k] *= cosine[k];
      return true;
    }
  } // namespace

  /** Adds J^-1 r to @p step until the residual is below @p target, and the corresponding change of the gap to
   * @p d_gap. Returns the number of iterations. */
  unsigned int JointJacobian::gmres(const Unknowns &r, double target, Unknowns &step, Unknowns &d_gap) const
  {
    const unsigned int n = W.n(), max_iterations = 100;
    double             norm = 0.;
    for (const double x : r)
      norm += x * x;
    norm = std::sqrt(norm);
    target = std::max(target, 1e-6 * norm); // limit of single precision
    if (!(norm > target))
      return 0;
    std::vector<Floats>              v(1, Floats(n)), z, Wz;
    std::vector<std::vector<double>> h; // columns of the Hessenberg matrix, made triangular by rotations
    std::vector<double>              cosine, sine, g(1, norm);
    for (unsigned int i = 0; i < n; ++i)
      v[0][i] = static_cast<float>(r[i] / norm);
    unsigned int k = 0;
    for (bool breakdown = false; k < max_iterations && std::abs(g[k]) > target && !breakdown; ++k)
    {
      z.emplace_back();
      Wz.emplace_back();
      Floats w;
      precondition(v[k], z[k], Wz[k]);
      multiply_J(z[k], Wz[k], w);
      std::vector<double> column(k + 2);
      for (unsigned int i = 0; i <= k; ++i)
      {
        column[i] = dot(v[i].data(), w.data(), n);
        add(-static_cast<float>(column[i]), v[i].data(), n, w.data());
      }
      const double next = column[k + 1] = std::sqrt(dot(w.data(), w.data(), n));
      if (!rotate(column, cosine, sine, g))
        break;
      h.push_back(column);
      breakdown = next < 1e-7 * column[k];
      for (float &x : w)
        x /= static_cast<float>(next);
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
      for (unsigned int j = 0; j < n; ++j)
      {
        step[j] += y[i] * z[i][j];
        d_gap[j] += y[i] * Wz[i][j];
      }
    return k;
  }

  // Defined here, so that the operator does not depend on its solver.
  std::unique_ptr<ContactJacobian> InterfaceOperator::make_jacobian() const
  {
    return std::make_unique<JointJacobian>(*this);
  }
} // namespace Voussoir
