// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/parallel.h>
#include <voussoir/joints/base_elimination.h>
#include <voussoir/joints/dense_kernels.h>
#include <voussoir/joints/interface_operator.h>

#include <algorithm>
#include <cassert>
#include <set>

namespace Voussoir
{
  InterfaceOperator::InterfaceOperator(const std::vector<unsigned int> &n_pairs, Shares given,
                                       std::vector<std::vector<unsigned int>> clusters)
      : clusters(std::move(clusters)), share(std::move(given)), offset(1, 0), coupled(n_pairs.size())
  {
    for (const unsigned int n : n_pairs)
      offset.push_back(offset.back() + 3 * n);
  }

  std::vector<double> &InterfaceOperator::block(const unsigned int j, const unsigned int k)
  {
    assert(k < n_groups());
    assert(j < k + 1);
    const auto inserted = blocks.try_emplace({j, k});
    if (inserted.second)
    {
      inserted.first->second.assign(holds(j, k) ? std::size_t(size(j)) * size(k) : 0, 0.);
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

  void InterfaceOperator::multiply(const Unknowns &x, Unknowns &y) const
  {
    assert(x.size() == n());
    // A block of two joints is used for both joints while it is in the cache. The two products are added
    // later in the order of the blocks, so that the result does not depend on the number of threads.
    std::vector<const std::pair<const std::pair<unsigned int, unsigned int>, std::vector<double>> *> list;
    for (const auto &b : blocks)
      if (!b.second.empty())
        list.push_back(&b);
    std::vector<std::array<std::vector<double>, 2>> products(list.size());
    for_each_parallel(list.size(),
                      [&](const int i)
                      {
                        const unsigned int j = list[i]->first.first, k = list[i]->first.second;
                        const double      *block = list[i]->second.data();
                        products[i][0].assign(size(j), 0.);
                        if (j == k)
                        {
                          add_symmetric(block, size(j), x.data() + offset[j], products[i][0].data());
                          return;
                        }
                        products[i][1].assign(size(k), 0.);
                        add_both(block, size(j), size(k), x.data() + offset[k], products[i][0].data(),
                                 x.data() + offset[j], products[i][1].data());
                      });
    y.assign(n(), 0.);
    for (std::size_t i = 0; i < list.size(); ++i)
      for (unsigned int side = 0; side < 2; ++side)
      {
        const unsigned int group = side == 0 ? list[i]->first.first : list[i]->first.second;
        double            *out = y.data() + offset[group];
        if (is_mine(group))
          for (const double p : products[i][side])
            *out++ += p;
      }
    gather(y);
    if (eliminated)
      eliminated->subtract(x.data(), y.data());
  }

  void InterfaceOperator::find_colours()
  {
    colour.assign(n_groups(), 0);
    groups_of_colour.clear();
    for (unsigned int g = 0; g < n_groups(); ++g)
    {
      std::vector<bool> taken(n_groups() + 1, false);
      for (const unsigned int k : coupled[g])
        if (k < g)
          taken[colour[k]] = true;
      colour[g] = std::find(taken.begin(), taken.end(), false) - taken.begin();
      groups_of_colour.resize(std::max<std::size_t>(groups_of_colour.size(), colour[g] + 1));
      groups_of_colour[colour[g]].push_back(g);
    }
  }

  void InterfaceOperator::finish(std::shared_ptr<const BaseElimination> base, const bool compact)
  {
    eliminated = std::move(base);
    diagonals.clear();
    const auto copy = [&]
    {
      find_diagonals();
      single.assign(n_groups(), {});
      couplings.clear();
      for (const auto &[groups, block] : blocks)
        if (groups.first == groups.second)
          single[groups.first].assign(block.begin(), block.end());
        else
          couplings.emplace(groups, CompactMatrix(block, size(groups.first), compact));
    };
    if (eliminated)
    {
      auto whole = blocks;
      eliminated->for_blocks([&](const unsigned int j, const unsigned int k)
                             { return find_block(j, k) != nullptr && holds(j, k); },
                             [&](const unsigned int j, const unsigned int k, const std::vector<double> &part)
                             {
                               std::vector<double> &block = whole.at({j, k});
                               for (std::size_t i = 0; i < part.size(); ++i)
                                 block[i] -= part[i];
                             });
      blocks.swap(whole);
      copy();
      blocks.swap(whole);
    }
    else
      copy();
    find_colours();
    to_neighbours.assign(groups_of_colour.size(), {});
    for (unsigned int g = 0; g < n_groups() && !share.are_trivial(); ++g)
    {
      std::set<unsigned int> to;
      for (const unsigned int k : coupled[g])
        if (share.owner(k) != share.owner(g) && size(k) > 0 && size(g) > 0)
          to.insert(share.owner(k));
      for (const unsigned int r : to)
        to_neighbours[colour[g]].push_back({g, begin(g), size(g), share.owner(g), r});
    }
  }

  void InterfaceOperator::find_diagonals()
  {
    diagonals.assign(n_pairs(), Matrix3{});
    for (unsigned int g = 0; g < n_groups(); ++g)
      for (unsigned int pair = offset[g] / 3; is_mine(g) && pair < offset[g + 1] / 3; ++pair)
        diagonals[pair] = diagonal_of_blocks(pair);
    if (share.are_trivial() || diagonals.empty())
      return;
    auto parts = share.parts(offset);
    for (std::size_t &begin : parts)
      begin *= 3; // nine values per pair
    Ranks::gather(diagonals[0].data(), parts);
  }

  std::vector<double> InterfaceOperator::own_block(const unsigned int group) const
  {
    if (!eliminated)
      return blocks.at({group, group});
    const Floats &block = single[group];
    return {block.begin(), block.end()};
  }

  void InterfaceOperator::add_single(const unsigned int j, const unsigned int k, const float *x,
                                     float *y) const
  {
    if (j == k)
    {
      if (!single[j].empty())
        add_symmetric(single[j].data(), size(j), size(j), x, y);
      return;
    }
    const CompactMatrix &block = coupling(std::min(j, k), std::max(j, k)); // empty: of other processes
    j < k ? block.add(x, y) : block.add_transposed(x, y);
  }

  void InterfaceOperator::sweep(const PairSolver &solve_pair, Unknowns &force, Unknowns &gap) const
  {
    assert(force.size() == n());
    assert(gap.size() == n());
    Floats change(n(), 0.f), moved(n(), 0.f); // changes of force and gap
    gauss_seidel(
        [&](const unsigned int g)
        {
          const unsigned int first = begin(g);
          sweep_group(g, solve_pair, force.data() + first, gap.data() + first, moved.data() + first,
                      change.data() + first);
        },
        change, moved);
    gather(force);
    for (unsigned int i = 0; i < n(); ++i)
      gap[i] += moved[i];
  }

  void InterfaceOperator::gather_pairs(Unknowns &values, const std::vector<std::size_t> &begin) const
  {
    if (share.are_trivial() || values.empty())
      return;
    std::vector<std::size_t> of_group;
    for (const unsigned int i : offset)
      of_group.push_back(begin[i / 3]);
    Ranks::gather(values.data(), share.parts(of_group));
  }

  /** Visits the pairs of group @p j in sequence, several times. The current gap is @p gap plus @p moved;
   * @p change receives the change of @p force. */
  void InterfaceOperator::sweep_group(const unsigned int j, const PairSolver &solve_pair, double *force,
                                      const double *gap, float *moved, float *change) const
  {
    constexpr unsigned int n_passes = 3; // passes over a block in the cache
    const unsigned int     m = size(j);
    const Floats          &w = single[j];
    for (unsigned int pass = 0; pass < n_passes; ++pass)
      for (unsigned int i = 0; i < m; i += 3)
      {
        double       *f = force + i;
        const Matrix3 H = diagonal((begin(j) + i) / 3);
        const Vector3 Hf = H * Vector3{{f[0], f[1], f[2]}};
        Vector3       free;
        for (unsigned int c = 0; c < 3; ++c)
          free[c] = gap[i + c] + moved[i + c] - Hf[c];
        const Vector3 solution = solve_pair((begin(j) + i) / 3, H, free);
        float         delta[3];
        for (unsigned int c = 0; c < 3; ++c)
        {
          delta[c] = static_cast<float>(solution[c] - f[c]);
          change[i + c] += delta[c];
          f[c] = solution[c];
        }
        if (delta[0] != 0.f || delta[1] != 0.f || delta[2] != 0.f)
          add_three_columns(w.data() + std::size_t(i) * m, m, delta, moved);
      }
  }

  Matrix3 InterfaceOperator::diagonal(const unsigned int pair) const
  {
    assert(pair < diagonals.size());
    return diagonals[pair];
  }

  Matrix3 InterfaceOperator::diagonal_of_blocks(const unsigned int pair) const
  {
    assert(pair < n_pairs());
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
    double bytes = 72. * diagonals.size() + (eliminated ? eliminated->memory() : 0.);
    for (const auto &b : blocks)
      bytes += 8. * b.second.size();
    for (const Floats &block : single)
      bytes += 4. * block.size();
    for (const auto &b : couplings)
      bytes += b.second.memory();
    return bytes;
  }
} // namespace Voussoir
