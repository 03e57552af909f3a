// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/blas.h>
#include <voussoir/joints/joint_chain.h>

namespace Voussoir
{
  JointChain::JointChain(const InterfaceOperator &W)
      : W(W), factors(W.n_groups()), below(W.n_groups()), above(W.n_groups())
  {
  }

  /** Fills @p out with the active rows and columns of d_gap W_jk; zero if the joints are not coupled. */
  void JointChain::fill_coupling(const unsigned int j, const unsigned int k, std::vector<float> &out) const
  {
    const auto &rows = factors[j].active, &columns = factors[k].active;
    out.assign(rows.size() * columns.size(), 0.f);
    if (!W.find_block(std::min(j, k), std::max(j, k)))
      return;
    const std::vector<float> block = W.coupling(std::min(j, k), std::max(j, k)).by_column();
    const std::size_t        along = j < k ? 1 : W.size(k), across = j < k ? W.size(j) : 1; // strides
    for (std::size_t c = 0; c < columns.size(); ++c)
      for (std::size_t r = 0; r < rows.size(); ++r)
      {
        const unsigned int pair = rows[r] / 3;
        const double      *g = factors[j].equations[pair].d_gap.data() + 3 * (rows[r] % 3);
        const float       *w = block.data() + columns[c] * across + 3 * pair * along;
        out[c * rows.size() + r] = static_cast<float>(g[0] * w[0] + g[1] * w[along] + g[2] * w[2 * along]);
      }
  }

  void JointChain::factorise(const std::vector<PairEquations> &equations)
  {
    const float one = 1.f, minus = -1.f;
    int         before = 0;
    for (unsigned int g = 0; g < W.n_groups(); ++g)
    {
      JointFactor &factor = factors[g];
      if (W.size(g) > 0)
        factor.find_active(W, g, equations.data() + W.begin(g) / 3);
      const int n = factor.size();
      if (n > 0 && W.is_mine(g))
        factor.assemble(W, g);
      if (n > 0 && before > 0)
      {
        if (W.is_mine(g - 1))
        {
          fill_coupling(g - 1, g, above[g]);
          factors[g - 1].solve(above[g].data(), n);
        }
        above[g].resize(std::size_t(n) * before);
        give(g - 1, g, above[g]);
        if (W.is_mine(g))
        {
          fill_coupling(g, g - 1, below[g]);
          sgemm_("N", "N", &n, &n, &before, &minus, below[g].data(), &n, above[g].data(), &before, &one,
                 factor.lu.data(), &n);
        }
      }
      if (W.is_mine(g))
        factor.factorise();
      before = n;
    }
  }

  /** Sends the values of joint @p from to the process of joint @p to. */
  void JointChain::give(const unsigned int from, const unsigned int to, std::vector<float> &values) const
  {
    if (const unsigned int owner = W.shares().owner(from); owner != W.shares().owner(to))
      Ranks::broadcast(values.data(), values.size(), owner);
  }

  void JointChain::solve(const std::vector<float> &v, std::vector<float> &z) const
  {
    const int                       stride = 1;
    const float                     one = 1.f, minus = -1.f;
    const unsigned int              n_groups = W.n_groups();
    std::vector<std::vector<float>> y(n_groups);
    for (unsigned int g = 0; g < n_groups; ++g)
    {
      const JointFactor &factor = factors[g];
      const int          n = factor.size(), before = g > 0 ? static_cast<int>(y[g - 1].size()) : 0;
      y[g].resize(n);
      if (g > 0)
        give(g - 1, g, y[g - 1]);
      if (!W.is_mine(g))
        continue;
      for (int i = 0; i < n; ++i)
        y[g][i] = v[W.begin(g) + factor.active[i]];
      if (n > 0 && before > 0)
        sgemv_("N", &n, &before, &minus, below[g].data(), &n, y[g - 1].data(), &stride, &one, y[g].data(),
               &stride);
      factor.solve(y[g].data(), 1);
    }
    for (unsigned int g = n_groups; g-- > 0;)
    {
      const int n = static_cast<int>(y[g].size()),
                after = g + 1 < n_groups ? static_cast<int>(y[g + 1].size()) : 0;
      if (g + 1 < n_groups)
        give(g + 1, g, y[g + 1]);
      if (!W.is_mine(g))
        continue;
      if (n > 0 && after > 0)
        sgemv_("N", &n, &after, &minus, above[g + 1].data(), &n, y[g + 1].data(), &stride, &one, y[g].data(),
               &stride);
      for (int i = 0; i < n; ++i)
        z[W.begin(g) + factors[g].active[i]] = y[g][i];
    }
    W.gather(z);
  }
} // namespace Voussoir
