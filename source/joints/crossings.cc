// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/blas.h>
#include <voussoir/base/parallel.h>
#include <voussoir/joints/crossings.h>

#include <algorithm>

namespace Voussoir
{
  namespace
  {
    /** Returns an entry of W in single precision. @p i, @p j: unknowns, counted from the first of their groups. */
    float entry(const InterfaceOperator &W, const unsigned int row_group, const unsigned int i,
                const unsigned int column_group, const unsigned int j)
    {
      if (row_group == column_group)
        return W.single_block(row_group)[std::size_t(j) * W.size(row_group) + i];
      return row_group < column_group ? W.coupling(row_group, column_group)(i, j)
                                      : W.coupling(column_group, row_group)(j, i);
    }
  } // namespace

  Crossings::Crossings(const InterfaceOperator &W) : W(W)
  {
    if (W.clusters.empty())
      return;
    std::vector<unsigned int> group; // of each pair
    for (unsigned int g = 0; g < W.n_groups(); ++g)
      group.insert(group.end(), W.size(g) / 3, g);
    unknowns.resize(W.n_groups());
    columns.resize(W.n_groups());
    for (const auto &pairs : W.clusters)
    {
      clusters.push_back({pairs, {}, {}});
      for (const unsigned int p : pairs)
        for (unsigned int c = 0; c < 3; ++c)
          unknowns[group[p]].push_back(3 * p + c - W.begin(group[p]));
      for (const unsigned int p : pairs)
        add_rows(p, group, clusters.back());
    }
    for (auto &list : unknowns)
      std::sort(list.begin(), list.end());
    for (unsigned int g = 0; g < W.n_groups(); ++g)
    {
      copy_columns(g, g);
      for (const unsigned int k : W.neighbours(g))
        copy_columns(g, k);
    }
  }

  /** Adds the three rows of pair @p p to the block of W of its cluster. The owner of the rows sends them to the other
   * processes. @p group: of each pair. */
  void Crossings::add_rows(const unsigned int p, const std::vector<unsigned int> &group,
                           Cluster &cluster) const
  {
    const unsigned int g = group[p], first = 3 * p - W.begin(g);
    const std::size_t  begin = cluster.W.size();
    for (unsigned int r = 0; r < 3; ++r)
      for (const unsigned int q : cluster.pairs)
        for (unsigned int c = 0; c < 3; ++c)
        {
          const unsigned int k = group[q];
          const bool         is_coupled = W.is_mine(g) && W.find_block(std::min(g, k), std::max(g, k));
          cluster.W.push_back(is_coupled ? entry(W, g, first + r, k, 3 * q + c - W.begin(k)) : 0.f);
        }
    if (!W.shares().are_trivial())
      Ranks::broadcast(cluster.W.data() + begin, cluster.W.size() - begin, W.shares().owner(g));
  }

  void Crossings::copy_columns(const unsigned int to, const unsigned int from)
  {
    if (unknowns[from].empty() || W.size(to) == 0 || !W.is_mine(to))
      return;
    Columns copy{from, {}};
    for (const unsigned int j : unknowns[from])
      for (unsigned int i = 0; i < W.size(to); ++i)
        copy.value.push_back(entry(W, to, i, from, j));
    columns[to].push_back(std::move(copy));
  }

  void Crossings::invert(const std::vector<PairEquations> &equations)
  {
    for_each_in_chunks(
        clusters.size(),
        [&](const std::size_t k)
        {
          Cluster           &cluster = clusters[k];
          const int          n = cluster.n();
          std::vector<float> lu(cluster.W.size());
          std::vector<int>   pivots(n);
          for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
            {
              const PairEquations &e = equations[cluster.pairs[i / 3]];
              const double        *g = e.d_gap.data() + 3 * (i % 3);
              const float         *w = cluster.W.data() + (i - i % 3) * n + j;
              const double         own = i / 3 == j / 3 ? e.d_force[3 * (i % 3) + j % 3] : 0.;
              lu[j * n + i] = static_cast<float>(own + g[0] * w[0] + g[1] * w[n] + g[2] * w[2 * n]);
            }
          int info = 0;
          sgetrf_(&n, &n, lu.data(), &n, pivots.data(), &info);
          cluster.inverse.assign(lu.size(), 0.f);
          for (int i = 0; i < n; ++i)
            cluster.inverse[i * n + i] = 1.f;
          if (info != 0) // singular: no correction of this cluster
          {
            std::fill(cluster.inverse.begin(), cluster.inverse.end(), 0.f);
            return;
          }
          sgetrs_("N", &n, &n, lu.data(), &n, pivots.data(), cluster.inverse.data(), &n, &info);
        });
  }

  void Crossings::correct(const std::vector<PairEquations> &equations, const std::vector<float> &v,
                          std::vector<float> &z, std::vector<float> &Wz) const
  {
    std::vector<float> change(z.size(), 0.f);
    for_each_in_chunks(clusters.size(),
                       [&](const std::size_t k)
                       {
                         const Cluster     &cluster = clusters[k];
                         const int          n = cluster.n();
                         std::vector<float> r(n);
                         for (int i = 0; i < n; ++i)
                         {
                           const unsigned int   p = cluster.pairs[i / 3];
                           const PairEquations &e = equations[p];
                           double               sum = v[3 * p + i % 3];
                           for (unsigned int c = 0; c < 3; ++c)
                             sum -= e.d_force[3 * (i % 3) + c] * z[3 * p + c] +
                                    e.d_gap[3 * (i % 3) + c] * Wz[3 * p + c];
                           r[i] = static_cast<float>(sum);
                         }
                         for (int j = 0; j < n; ++j)
                           for (int i = 0; i < n; ++i)
                             change[3 * cluster.pairs[i / 3] + i % 3] += cluster.inverse[j * n + i] * r[j];
                       });
    for (std::size_t i = 0; i < z.size(); ++i)
      z[i] += change[i];
    for_each_parallel(W.n_groups(),
                      [&](const int g)
                      {
                        for (const Columns &part : columns[g])
                        {
                          std::vector<float> x;
                          for (const unsigned int j : unknowns[part.from])
                            x.push_back(change[W.begin(part.from) + j]);
                          const int   rows = W.size(g), n = x.size(), stride = 1;
                          const float one = 1.f;
                          sgemv_("N", &rows, &n, &one, part.value.data(), &rows, x.data(), &stride, &one,
                                 Wz.data() + W.begin(g), &stride);
                        }
                      });
    W.gather(Wz);
  }
} // namespace Voussoir
