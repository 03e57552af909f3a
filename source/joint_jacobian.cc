#include <voussoir/joint_jacobian.h>

#include <algorithm>
#include <cmath>

extern "C"
{
  void sgetrf_(const int *, const int *, float *, const int *, int *, int *);
  void sgetrs_(const char *, const int *, const int *, const float *, const int *, const int *, float *,
               const int *, int *);
  void sgemv_(const char *, const int *, const int *, const float *, const float *, const int *,
              const float *, const int *, const float *, float *, const int *);
}

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

    /** The row says: this component of the force is given. */
    bool row_is_trivial(const PairEquations &e, const unsigned int i)
    {
      for (unsigned int j = 0; j < 3; ++j)
        if (e.d_gap[3 * i + j] != 0. || e.d_force[3 * i + j] != (i == j ? 1. : 0.))
          return false;
      return true;
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
        if (const std::vector<double> *block = W.find_block(g, k))
          blocks[{g, k}].assign(block->begin(), block->end());
  }

  bool JointJacobian::needs_factor(const unsigned int group) const
  {
    // Stale factors still precondition well when only directions of slip have turned a little.
    constexpr double tolerated = .3;
    const Factor    &factor = factors[group];
    const auto      *present = equations->data() + W.begin(group) / 3;
    if (factor.equations.empty())
      return true;
    for (std::size_t i = 0; i < factor.equations.size(); ++i)
    {
      const PairEquations &a = factor.equations[i], &b = present[i];
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
    unsigned int count = 0;
#pragma omp parallel for schedule(dynamic) reduction(+ : count)
    for (int g = 0; g < static_cast<int>(W.n_groups()); ++g)
      if (W.size(g) > 0)
      {
        if (needs_factor(g))
        {
          factorise(g);
          ++count;
        }
        const auto *present = equations->data() + W.begin(g) / 3;
        Factor     &factor = factors[g];
        factor.exact = std::equal(factor.equations.begin(), factor.equations.end(), present,
                                  [](const PairEquations &a, const PairEquations &b)
                                  { return a.d_force == b.d_force && a.d_gap == b.d_gap; });
      }
    return count;
  }

  void JointJacobian::factorise(const unsigned int group)
  {
    const auto        *present = equations->data() + W.begin(group) / 3;
    const unsigned int n_pairs = W.size(group) / 3;
    Factor            &factor = factors[group];
    factor.equations.assign(present, present + n_pairs);
    factor.active.clear();
    for (unsigned int i = 0; i < n_pairs; ++i)
      for (unsigned int c = 0; c < 3; ++c)
        if (!row_is_trivial(present[i], c))
          factor.active.push_back(3 * i + c);
    const Floats &w = blocks.at({group, group});
    const int     n = factor.active.size(), ld = W.size(group);
    factor.lu.resize(std::size_t(n) * n);
    factor.pivots.resize(n);
    for (int column = 0; column < n; ++column)
    {
      const unsigned int k = factor.active[column];
      const float       *w_k = w.data() + std::size_t(k) * ld;
      float             *out = factor.lu.data() + std::size_t(column) * n;
      for (int row = 0; row < n; ++row)
      {
        const unsigned int j = factor.active[row], pair = j / 3, c = 3 * (j % 3);
        const double      *g = present[pair].d_gap.data() + c;
        out[row] =
            static_cast<float>(g[0] * w_k[3 * pair] + g[1] * w_k[3 * pair + 1] + g[2] * w_k[3 * pair + 2] +
                               (k / 3 == pair ? present[pair].d_force[c + k % 3] : 0.));
      }
    }
    int info = 0;
    if (n > 0)
      sgetrf_(&n, &n, factor.lu.data(), &n, factor.pivots.data(), &info);
  }

  void JointJacobian::apply_factor(const unsigned int group, float *x) const
  {
    const Factor &factor = factors[group];
    const int     n = factor.active.size(), one = 1;
    if (n == 0)
      return;
    Floats z(n);
    int    info = 0;
    for (int i = 0; i < n; ++i)
      z[i] = x[factor.active[i]];
    sgetrs_("N", &n, &one, factor.lu.data(), &n, factor.pivots.data(), z.data(), &n, &info);
    for (int i = 0; i < n; ++i)
      x[factor.active[i]] = z[i];
  }

  /** y += W_jk x. */
  void JointJacobian::multiply_block(const unsigned int j, const unsigned int k, const float *x,
                                     float *y) const
  {
    const Floats &block = blocks.at({std::min(j, k), std::max(j, k)});
    const int     rows = W.size(std::min(j, k)), columns = W.size(std::max(j, k)), stride = 1;
    const float   one = 1.f;
    if (!block.empty())
      sgemv_(j <= k ? "N" : "T", &rows, &columns, &one, block.data(), &rows, x, &stride, &one, y, &stride);
  }

  /** v_group += (-) d_gap sum_k W_k z_k over the neighbours of later (earlier) colour. */
  void JointJacobian::add_couplings(const Floats &z, Floats &v, const unsigned int group,
                                    const bool later) const
  {
    Floats w(W.size(group), 0.f);
    bool   any = false;
    for (const unsigned int k : W.neighbours(group))
      if ((colour[k] > colour[group]) == later)
      {
        multiply_block(group, k, z.data() + W.begin(k), w.data());
        any = true;
      }
    for (unsigned int i = 0; any && i < W.size(group) / 3; ++i)
    {
      const Vector3 x =
          (*equations)[W.begin(group) / 3 + i].d_gap * Vector3{{w[3 * i], w[3 * i + 1], w[3 * i + 2]}};
      for (unsigned int c = 0; c < 3; ++c)
        v[W.begin(group) + 3 * i + c] += static_cast<float>(later ? x[c] : -x[c]);
    }
  }

  /** z = P^-1 v. */
  void JointJacobian::precondition(const Floats &v, Floats &z) const
  {
    z = v;
    for (const auto &groups : groups_of_colour)
#pragma omp parallel for schedule(dynamic)
      for (int i = 0; i < static_cast<int>(groups.size()); ++i)
      {
        add_couplings(z, z, groups[i], false);
        apply_factor(groups[i], z.data() + W.begin(groups[i]));
      }
  }

  /** w = J z, where z = P^-1 v. */
  void JointJacobian::multiply(const Floats &v, const Floats &z, Floats &w) const
  {
    w = v;
#pragma omp parallel for schedule(dynamic)
    for (int g = 0; g < static_cast<int>(W.n_groups()); ++g)
    {
      add_couplings(z, w, g, true);
      if (factors[g].exact || W.size(g) == 0)
        continue;
      Floats Wz(W.size(g), 0.f);
      multiply_block(g, g, z.data() + W.begin(g), Wz.data());
      for (unsigned int i = 0; i < W.size(g) / 3; ++i)
      {
        const PairEquations &a = factors[g].equations[i], &b = (*equations)[W.begin(g) / 3 + i];
        for (unsigned int c = 0; c < 9; ++c)
          w[W.begin(g) + 3 * i + c / 3] +=
              static_cast<float>((b.d_force[c] - a.d_force[c]) * z[W.begin(g) + 3 * i + c % 3] +
                                 (b.d_gap[c] - a.d_gap[c]) * Wz[3 * i + c % 3]);
      }
    }
  }

  /** y = W x. */
  void JointJacobian::multiply_W(const Unknowns &x, Unknowns &y) const
  {
    const Floats in(x.begin(), x.end());
    Floats       out(x.size(), 0.f);
#pragma omp parallel for schedule(dynamic)
    for (int j = 0; j < static_cast<int>(W.n_groups()); ++j)
    {
      multiply_block(j, j, in.data() + W.begin(j), out.data() + W.begin(j));
      for (const unsigned int k : W.neighbours(j))
        multiply_block(j, k, in.data() + W.begin(k), out.data() + W.begin(j));
    }
    y.assign(out.begin(), out.end());
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
    if (trivial)
    {
      multiply_W(step, d_gap);
      for (std::size_t i = 0; i < equations->size(); ++i)
      {
        const Vector3 f = (*equations)[i].d_force * Vector3{{step[3 * i], step[3 * i + 1], step[3 * i + 2]}},
                      g = (*equations)[i].d_gap * Vector3{{d_gap[3 * i], d_gap[3 * i + 1], d_gap[3 * i + 2]}};
        for (unsigned int c = 0; c < 3; ++c)
          r[3 * i + c] -= f[c] + g[c];
      }
    }
    const unsigned int iterations = gmres(r, tolerance * std::sqrt(all), step);
    multiply_W(step, d_gap);
    return iterations;
  }

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
      precondition(v[k], z[k]);
      Floats w;
      multiply(v[k], z[k], w);
      std::vector<double> column(k + 2);
      for (unsigned int i = 0; i <= k; ++i)
      {
        column[i] = dot(v[i], w);
        for (unsigned int j = 0; j < n; ++j)
          w[j] -= static_cast<float>(column[i]) * v[i][j];
      }
      const double next = column[k + 1] = std::sqrt(dot(w, w));
      for (unsigned int i = 0; i < k; ++i)
      {
        const double t = cosine[i] * column[i] + sine[i] * column[i + 1];
        column[i + 1] = -sine[i] * column[i] + cosine[i] * column[i + 1];
        column[i] = t;
      }
      const double radius = std::hypot(column[k], column[k + 1]);
      if (!(radius > 0.) || !std::isfinite(radius))
        break;
      cosine.push_back(column[k] / radius);
      sine.push_back(column[k + 1] / radius);
      column[k] = radius;
      h.push_back(column);
      g.push_back(-sine[k] * g[k]);
      g[k] *= cosine[k];
      breakdown = next < 1e-7 * radius;
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
} // namespace Voussoir
