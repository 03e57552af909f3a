// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/exceptions.h>

#include <voussoir/base/parallel.h>
#include <voussoir/joints/interface_operator.h>

#include <algorithm>

extern "C" void dgemv_(const char *, const int *, const int *, const double *, const double *, const int *,
                       const double *, const int *, const double *, double *, const int *);

extern "C" void sgemv_(const char *, const int *, const int *, const float *, const float *, const int *,
                       const float *, const int *, const float *, float *, const int *);

namespace Voussoir
{
  InterfaceOperator::InterfaceOperator(const std::vector<unsigned int> &n_pairs)
      : offset(1, 0), coupled(n_pairs.size())
  {
    for (const unsigned int n : n_pairs)
      offset.push_back(offset.back() + 3 * n);
  }

  std::vector<double> &InterfaceOperator::block(const unsigned int j, const unsigned int k)
  {
    AssertIndexRange(k, n_groups());
    AssertIndexRange(j, k + 1);
    const auto inserted = blocks.try_emplace({j, k});
    if (inserted.second)
    {
      inserted.first->second.assign(std::size_t(size(j)) * size(k), 0.);
      if (j != k)
      {
        coupled[j].push_back(k);
        coupled[k].push_back(j);
        for (const unsigned int g : {j, k})
          std::sort(coupled[g].begin(), coupled[g].end());
      }
    }
    return inserted.first->second;
  }

  void InterfaceOperator::add_coupling(const unsigned int j, const unsigned int k, const double factor,
                                       const double *x, double *y) const
  {
    const auto found = blocks.find({std::min(j, k), std::max(j, k)});
    if (found == blocks.end() || found->second.empty())
      return;
    const int    rows = size(std::min(j, k)), columns = size(std::max(j, k)), stride = 1;
    const double one = 1.;
    dgemv_(j <= k ? "N" : "T", &rows, &columns, &factor, found->second.data(), &rows, x, &stride, &one, y,
           &stride);
  }

  void InterfaceOperator::multiply(const Unknowns &x, Unknowns &y) const
  {
    AssertDimension(x.size(), n());
    // A block of two joints serves both while it is in the cache; its two products are added up afterwards,
    // in the order of the blocks, so that the result does not depend on the number of threads.
    std::vector<const std::pair<const std::pair<unsigned int, unsigned int>, std::vector<double>> *> list;
    for (const auto &b : blocks)
      list.push_back(&b);
    std::vector<std::array<std::vector<double>, 2>> products(list.size());
    for_each_parallel(list.size(),
                      [&](const int i)
                      {
                        const unsigned int j = list[i]->first.first, k = list[i]->first.second;
                        products[i][0].assign(size(j), 0.);
                        add_coupling(j, k, 1., x.data() + offset[k], products[i][0].data());
                        if (j != k)
                        {
                          products[i][1].assign(size(k), 0.);
                          add_coupling(k, j, 1., x.data() + offset[j], products[i][1].data());
                        }
                      });
    y.assign(n(), 0.);
    for (std::size_t i = 0; i < list.size(); ++i)
      for (unsigned int side = 0; side < 2; ++side)
      {
        double *out = y.data() + offset[side == 0 ? list[i]->first.first : list[i]->first.second];
        for (const double p : products[i][side])
          *out++ += p;
      }
  }

  std::vector<std::vector<unsigned int>> InterfaceOperator::colours() const
  {
    std::vector<std::vector<unsigned int>> result;
    std::vector<unsigned int>              colour(n_groups(), 0);
    for (unsigned int g = 0; g < n_groups(); ++g)
    {
      std::vector<bool> taken(n_groups() + 1, false);
      for (const unsigned int k : coupled[g])
        if (k < g)
          taken[colour[k]] = true;
      colour[g] = std::find(taken.begin(), taken.end(), false) - taken.begin();
      result.resize(std::max<std::size_t>(result.size(), colour[g] + 1));
      result[colour[g]].push_back(g);
    }
    return result;
  }

  void InterfaceOperator::finish()
  {
    single.clear();
    for (const auto &b : blocks)
      single[b.first].assign(b.second.begin(), b.second.end());
  }

  void InterfaceOperator::add_single(const unsigned int j, const unsigned int k, const float *x,
                                     float *y) const
  {
    const std::vector<float> &b = single.at({std::min(j, k), std::max(j, k)});
    const int                 rows = size(std::min(j, k)), columns = size(std::max(j, k)), stride = 1;
    const float               one = 1.f;
    if (!b.empty())
      sgemv_(j <= k ? "N" : "T", &rows, &columns, &one, b.data(), &rows, x, &stride, &one, y, &stride);
  }

  void InterfaceOperator::sweep(const PairSolver &solve_pair, Unknowns &force, Unknowns &gap) const
  {
    AssertDimension(force.size(), n());
    AssertDimension(gap.size(), n());
    std::vector<float> change(n());
    for (const auto &groups : colours())
    {
      for_each_parallel(groups.size(),
                        [&](const int index) { sweep_group(groups[index], solve_pair, force, gap, change); });
      // What the change does to the other groups; each of them is the work of one thread.
      for_each_parallel(n_groups(),
                        [&](const int k)
                        {
                          std::vector<float> sum(size(k), 0.f);
                          bool               any = false;
                          for (const unsigned int j : coupled[k])
                            if (std::binary_search(groups.begin(), groups.end(), j))
                            {
                              add_single(k, j, change.data() + begin(j), sum.data());
                              any = true;
                            }
                          for (unsigned int i = 0; any && i < size(k); ++i)
                            gap[begin(k) + i] += sum[i];
                        });
    }
  }

  /** The pairs of one group, one after the other; @p change: of their forces. */
  void InterfaceOperator::sweep_group(const unsigned int j, const PairSolver &solve_pair, Unknowns &force,
                                      Unknowns &gap, std::vector<float> &change) const
  {
    const unsigned int         m = size(j);
    const std::vector<double> &exact = blocks.at({j, j});
    const std::vector<float>  &w = single.at({j, j});
    double                    *d = gap.data() + begin(j);
    for (unsigned int i = 0; i < m; i += 3)
    {
      double *f = force.data() + begin(j) + i;
      Matrix3 H;
      for (unsigned int r = 0; r < 3; ++r)
        for (unsigned int c = 0; c < 3; ++c)
          H[3 * r + c] = exact[std::size_t(i + c) * m + i + r];
      const Vector3 Hf = H * Vector3{{f[0], f[1], f[2]}};
      const Vector3 solution =
          solve_pair((begin(j) + i) / 3, H, {{d[i] - Hf[0], d[i + 1] - Hf[1], d[i + 2] - Hf[2]}});
      float *delta = change.data() + begin(j) + i;
      for (unsigned int c = 0; c < 3; ++c)
      {
        delta[c] = static_cast<float>(solution[c] - f[c]);
        f[c] = solution[c];
      }
      if (delta[0] == 0.f && delta[1] == 0.f && delta[2] == 0.f)
        continue;
      const float *w0 = w.data() + std::size_t(i) * m, *w1 = w0 + m, *w2 = w1 + m;
      for (unsigned int row = 0; row < m; ++row)
        d[row] += delta[0] * w0[row] + delta[1] * w1[row] + delta[2] * w2[row];
    }
  }

  Matrix3 InterfaceOperator::diagonal(const unsigned int pair) const
  {
    AssertIndexRange(pair, n_pairs());
    const unsigned int group = std::upper_bound(offset.begin(), offset.end(), 3 * pair) - offset.begin() - 1;
    const std::vector<double> &b = blocks.at({group, group});
    const std::size_t          first = 3 * pair - offset[group], m = size(group);
    Matrix3                    result;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        result[3 * i + j] = b[(first + j) * m + first + i];
    return result;
  }

  double InterfaceOperator::memory() const
  {
    double bytes = 0;
    for (const auto &b : blocks)
      bytes += 12. * b.second.size();
    return bytes;
  }
} // namespace Voussoir
