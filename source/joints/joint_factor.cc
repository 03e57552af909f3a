// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/blas.h>
#include <voussoir/joints/joint_factor.h>

namespace Voussoir
{
  bool row_is_trivial(const PairEquations &e, const unsigned int i)
  {
    for (unsigned int j = 0; j < 3; ++j)
      if (e.d_gap[3 * i + j] != 0. || e.d_force[3 * i + j] != (i == j ? 1. : 0.))
        return false;
    return true;
  }

  void JointFactor::find_active(const InterfaceOperator &W, const unsigned int group,
                                const PairEquations *present)
  {
    const unsigned int n_pairs = W.size(group) / 3;
    equations.assign(present, present + n_pairs);
    active.clear();
    for (unsigned int i = 0; i < n_pairs; ++i)
      for (unsigned int c = 0; c < 3; ++c)
        if (!row_is_trivial(present[i], c))
          active.push_back(3 * i + c);
  }

  void JointFactor::assemble(const InterfaceOperator &W, const unsigned int group)
  {
    lu.resize(active.size() * active.size());
    pivots.resize(active.size());
    const std::vector<float> &w = W.single_block(group);
    const int                 n = size(), ld = W.size(group);
    for (int column = 0; column < n; ++column)
    {
      const unsigned int k = active[column];
      const float       *w_k = w.data() + std::size_t(k) * ld;
      float             *out = lu.data() + std::size_t(column) * n;
      for (int row = 0; row < n; ++row)
      {
        const unsigned int   j = active[row], pair = j / 3, c = 3 * (j % 3);
        const PairEquations &e = equations[pair];
        const double        *g = e.d_gap.data() + c;
        out[row] = static_cast<float>(g[0] * w_k[3 * pair] + g[1] * w_k[3 * pair + 1] +
                                      g[2] * w_k[3 * pair + 2] + (k / 3 == pair ? e.d_force[c + k % 3] : 0.));
      }
    }
  }

  void JointFactor::factorise()
  {
    const int n = size();
    int       info = 0;
    if (n > 0)
      sgetrf_(&n, &n, lu.data(), &n, pivots.data(), &info);
  }

  void JointFactor::solve(float *x, const int columns) const
  {
    const int n = size();
    int       info = 0;
    if (n > 0 && columns > 0)
      sgetrs_("N", &n, &columns, lu.data(), &n, pivots.data(), x, &n, &info);
  }
} // namespace Voussoir
