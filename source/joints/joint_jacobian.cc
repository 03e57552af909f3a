// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/parallel.h>
#include <voussoir/joints/joint_jacobian.h>

#include <algorithm>
#include <cmath>
#include <numeric>

extern "C" float sdot_(const int *, const float *, const int *, const float *, const int *);

namespace Voussoir
{
  namespace
  {
    using Floats = std::vector<float>;

    double dot(const Floats &a, const Floats &b)
    {
      double sum = 0.;
      for (std::size_t i = 0; i < a.size(); ++i)
        sum += double(a[i]) * b[i];
      return sum;
    }
  } // namespace

  JointJacobian::JointJacobian(const InterfaceOperator &W)
      : W(W), factors(W.n_groups()), groups_of_colour(W.colours()), colour(W.n_groups(), 0)
  {
    for (unsigned int c = 0; c < groups_of_colour.size(); ++c)
      for (const unsigned int g : groups_of_colour[c])
        colour[g] = c;
    for (unsigned int g = 0; g < W.n_groups(); ++g)
      for (unsigned int k = g; k < W.n_groups(); ++k)
        if (const std::vector<double> *block = W.find_block(g, k); block && !block->empty())
        {
          keys.push_back({g, k});
          is_chain = is_chain && k <= g + 1;
        }
  }

  bool JointJacobian::needs_factor(const unsigned int group) const
  {
    // Stale factors still precondition well when only directions of slip have turned a little.
    constexpr double tolerated = .3;
    const Factor    &factor = factors[group];
    if (factor.equations.empty())
      return true;
    for (std::size_t i = 0; i < factor.equations.size(); ++i)
    {
      const PairEquations &a = factor.equations[i], &b = present(group)[i];
      for (unsigned int k = 0; k < 3; ++k)
        if (row_is_trivial(a, k) != row_is_trivial(b, k))
          return true;
      for (unsigned int k = 0; k < 9; ++k)
        if (std::abs(a.d_force[k] - b.d_force[k]) > tolerated)
          return true;
    }
    return false;
  }

  unsigned int JointJacobian::update(const std::vector<PairEquations> &new_equations)
  {
    equations = &new_equations;
    if (use_chain)
    {
      if (!chain)
      {
        chain = std::make_unique<JointChain>(W);
        factors.clear();
      }
      chain->factorise(new_equations);
      return W.n_groups();
    }
    std::vector<unsigned int> made(W.n_groups(), 0);
    for_each_parallel(W.n_groups(),
                      [&](const int g)
                      {
                        if (W.size(g) > 0)
                        {
                          if (needs_factor(g))
                          {
                            factors[g].assemble(W, g, present(g));
                            factors[g].factorise();
                            made[g] = 1;
                          }
                          Factor &factor = factors[g];
                          factor.exact =
                              std::equal(factor.equations.begin(), factor.equations.end(), present(g),
                                         [](const PairEquations &a, const PairEquations &b)
                                         { return a.d_force == b.d_force && a.d_gap == b.d_gap; });
                        }
                      });
    return std::accumulate(made.begin(), made.end(), 0u);
  }

  void JointJacobian::apply_factor(const unsigned int group, float *x) const
  {
    const Factor &factor = factors[group];
    const int     n = factor.size();
    Floats        z(n);
    for (int i = 0; i < n; ++i)
      z[i] = x[factor.active[i]];
    factor.solve(z.data(), 1);
    for (int i = 0; i < n; ++i)
      x[factor.active[i]] = z[i];
  }

  /** y += factor * d_gap x, in the rows of a group. */
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

  /** y = W x. Each block serves both of its groups while it is in the cache. */
  void JointJacobian::multiply_W(const Floats &x, Floats &y) const
  {
    std::vector<std::array<Floats, 2>> products(keys.size());
    for_each_parallel(keys.size(),
                      [&](const int i)
                      {
                        const unsigned int j = keys[i].first, k = keys[i].second;
                        products[i][0].assign(W.size(j), 0.f);
                        W.add_single(j, k, x.data() + W.begin(k), products[i][0].data());
                        if (j != k)
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
  }

  /** y = W x for an @p x with few entries. */
  void JointJacobian::multiply_W_sparse(const Unknowns &x, Floats &y) const
  {
    y.assign(W.n(), 0.f);
    for (unsigned int k = 0; k < W.n_groups(); ++k)
    {
      std::vector<unsigned int> entries;
      for (unsigned int i = 0; i < W.size(k); ++i)
        if (x[W.begin(k) + i] != 0.)
          entries.push_back(i);
      if (entries.empty())
        continue;
      std::vector<unsigned int> groups = W.neighbours(k);
      groups.push_back(k);
      for (const unsigned int j : groups)
      {
        const Floats     &block = coupling(j, k);
        const std::size_t along = j <= k ? 1 : W.size(k), across = j <= k ? W.size(j) : 1; // strides
        float            *out = y.data() + W.begin(j);
        for (const unsigned int i : entries)
        {
          const float  factor = static_cast<float>(x[W.begin(k) + i]);
          const float *column = block.data() + i * across;
          for (unsigned int row = 0; row < W.size(j); ++row)
            out[row] += factor * column[row * along];
        }
      }
    }
  }

  /** z = P^-1 v and w = J z. */
  void JointJacobian::apply(const Floats &v, Floats &z, Floats &w) const
  {
    z = v;
    if (chain)
    {
      chain->solve(v, z);
      multiply_J(z, w);
      return;
    }
    w = v;
    std::vector<std::vector<Floats>> back(W.n_groups()); // W_kg z_g for the earlier neighbours k of g
    const auto                       for_earlier = [this](const unsigned int g, const auto &action)
    {
      for (const unsigned int k : W.neighbours(g))
        if (colour[k] < colour[g] && W.size(k) > 0 && W.size(g) > 0)
          action(k);
    };
    for (const auto &groups : groups_of_colour)
      for_each_parallel(groups.size(),
                        [&](const int i)
                        {
                          const unsigned int g = groups[i];
                          float             *z_g = z.data() + W.begin(g);
                          Floats             sum(W.size(g), 0.f);
                          for_earlier(g, [&](const unsigned int k)
                                      { W.add_single(g, k, z.data() + W.begin(k), sum.data()); });
                          multiply_by_d_gap(g, -1.f, sum.data(), z_g);
                          apply_factor(g, z_g);
                          for_earlier(g,
                                      [&](const unsigned int k)
                                      {
                                        back[g].emplace_back(W.size(k), 0.f);
                                        W.add_single(k, g, z_g, back[g].back().data());
                                      });
                        });
    for (unsigned int g = 0; g < W.n_groups(); ++g)
    {
      auto product = back[g].begin();
      for_earlier(g, [&](const unsigned int k)
                  { multiply_by_d_gap(k, 1.f, (product++)->data(), w.data() + W.begin(k)); });
    }
    for_each_parallel(W.n_groups(),
                      [&](const int g)
                      {
                        if (!factors[g].exact && W.size(g) > 0)
                          correct_stale(g, z, w);
                      });
  }

  /** w = J z. */
  void JointJacobian::multiply_J(const Floats &z, Floats &w) const
  {
    Floats Wz;
    multiply_W(z, Wz);
    w.assign(W.n(), 0.f);
    for (unsigned int g = 0; g < W.n_groups(); ++g)
    {
      multiply_by_d_gap(g, 1.f, Wz.data() + W.begin(g), w.data() + W.begin(g));
      for (unsigned int i = 0; i < W.size(g); ++i)
        for (unsigned int c = 0; c < 3; ++c)
          w[W.begin(g) + i] +=
              static_cast<float>(present(g)[i / 3].d_force[3 * (i % 3) + c] * z[W.begin(g) + i - i % 3 + c]);
    }
  }

  /** w += (J - D - L - U) z in the rows of a group whose factors are of older equations. */
  void JointJacobian::correct_stale(const unsigned int g, const Floats &z, Floats &w) const
  {
    const Floats &block = coupling(g, g);
    const float  *z_g = z.data() + W.begin(g);
    const int     m = W.size(g), stride = 1;
    for (int i = 0; i < m; i += 3)
    {
      const PairEquations &a = factors[g].equations[i / 3], &b = present(g)[i / 3];
      if (a.d_force == b.d_force && a.d_gap == b.d_gap)
        continue;
      float Wz[3]; // rows are columns
      for (unsigned int c = 0; c < 3; ++c)
        Wz[c] = sdot_(&m, block.data() + std::size_t(i + c) * m, &stride, z_g, &stride);
      for (unsigned int c = 0; c < 9; ++c)
        w[W.begin(g) + i + c / 3] += static_cast<float>((b.d_force[c] - a.d_force[c]) * z_g[i + c % 3] +
                                                        (b.d_gap[c] - a.d_gap[c]) * Wz[c % 3]);
    }
  }

  unsigned int JointJacobian::solve(const double tolerance, Unknowns &step, Unknowns &d_gap)
  {
    const unsigned int n = W.n();
    // The trivial rows first: they are exact, and stay zero in all that follows.
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
    const unsigned int iterations = gmres(r, tolerance * std::sqrt(all), step);
    if (iterations > 20)
      use_chain = is_chain; // from the next equations on
    multiply_W(Floats(step.begin(), step.end()), w);
    d_gap.assign(w.begin(), w.end());
    return iterations;
  }

  namespace
  {
    /** Makes a column of the Hessenberg matrix triangular by the rotations of the columns before, and one of
     * its own; applies that to the right-hand side @p g. False if the column is nothing. */
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

  /** step += J^-1 r, until the residual is below @p target. */
  unsigned int JointJacobian::gmres(const Unknowns &r, double target, Unknowns &step) const
  {
    const unsigned int n = W.n(), max_iterations = 100;
    double             norm = 0.;
    for (const double x : r)
      norm += x * x;
    norm = std::sqrt(norm);
    target = std::max(target, 1e-6 * norm); // what single precision can do
    if (!(norm > target))
      return 0;
    std::vector<Floats>              v(1, Floats(n)), z;
    std::vector<std::vector<double>> h; // columns of the Hessenberg matrix, made triangular by rotations
    std::vector<double>              cosine, sine, g(1, norm);
    for (unsigned int i = 0; i < n; ++i)
      v[0][i] = static_cast<float>(r[i] / norm);
    unsigned int k = 0;
    for (bool breakdown = false; k < max_iterations && std::abs(g[k]) > target && !breakdown; ++k)
    {
      z.emplace_back();
      Floats w;
      apply(v[k], z[k], w);
      std::vector<double> column(k + 2);
      for (unsigned int i = 0; i <= k; ++i)
      {
        column[i] = dot(v[i], w);
        for (unsigned int j = 0; j < n; ++j)
          w[j] -= static_cast<float>(column[i]) * v[i][j];
      }
      const double next = column[k + 1] = std::sqrt(dot(w, w));
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
        step[j] += y[i] * z[i][j];
    return k;
  }

  // Here, so that the operator does not need to know its solver.
  std::unique_ptr<ContactJacobian> InterfaceOperator::make_jacobian() const
  {
    return std::make_unique<JointJacobian>(*this);
  }
} // namespace Voussoir
