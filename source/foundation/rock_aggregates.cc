// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/internal_error.h>
#include <voussoir/base/parallel.h>
#include <voussoir/foundation/rock_aggregates.h>
#include <voussoir/rock/rock_split.h>

#include <algorithm>
#include <functional>
#include <map>

namespace Voussoir
{
  namespace
  {
    constexpr unsigned int none = RockAggregates::none;

    double square(const Matrix3 &a)
    {
      double sum = 0.;
      for (const double x : a)
        sum += x * x;
      return sum;
    }

    /** Couplings of the nodes: squared norms of the blocks of the stiffness matrix, relative to the diagonal
     * blocks of both nodes; 0 with a held node. Each rank computes those of its rows (RockSplit) and receives the
     * others. */
    struct Couplings
    {
      std::vector<std::size_t>  start; ///< of each row
      std::vector<unsigned int> column;
      std::vector<double> value, limit; ///< of the blocks; least value of a strong coupling of each node

      Couplings(const BlockSparseMatrix &K, const std::vector<bool> &held, const double strong) : start(1, 0)
      {
        const unsigned int  n = K.n_rows();
        const RockSplit     split(n);
        const auto          is_mine = [&](const unsigned int i) { return split.owner(i) == Ranks::rank(); };
        std::vector<double> length(n), diagonal(n, 0.);
        for (unsigned int i = 0; i < n; ++i)
          length[i] = double(K.start[i + 1] - K.start[i]);
        split.gather(length, 1);
        std::vector<std::size_t> parts(1, 0); // of the ranks
        for (unsigned int i = 0; i < n; ++i)
        {
          parts.resize(std::max<std::size_t>(parts.size(), split.owner(i) + 1), start[i]);
          start.push_back(start[i] + static_cast<std::size_t>(length[i]));
        }
        parts.resize(Ranks::size() + 1, start[n]);
        column.resize(start[n]);
        value.resize(start[n]);
        for (unsigned int i = 0; i < n; ++i)
          for (std::size_t k = K.start[i], at = start[i]; is_mine(i) && k < K.start[i + 1]; ++k, ++at)
          {
            column[at] = K.column[k];
            value[at] = square(K.value[k]);
            diagonal[i] = column[at] == i ? value[at] : diagonal[i];
          }
        if (!split.is_trivial())
        {
          Ranks::gather(column.data(), parts);
          Ranks::gather(value.data(), parts);
          split.gather(diagonal, 1);
        }
        for (unsigned int i = 0; i < n; ++i)
          for (std::size_t k = start[i]; k < start[i + 1]; ++k)
            value[k] = held[column[k]] ? 0. : value[k] / std::sqrt(diagonal[i] * diagonal[column[k]]);
        for (unsigned int i = 0; i < n; ++i)
          limit.push_back(limit_of(i, strong));
      }

      unsigned int n_rows() const { return static_cast<unsigned int>(limit.size()); }

    private:
      /** Returns the least value of a strong coupling of @p node. Each node has at least four, so that the groups
       * of flat elements are not small and many. */
      double limit_of(const unsigned int node, const double strong) const
      {
        const double        round_off = 1e-8;
        const std::size_t   least = 5;   // with the node itself
        constexpr double    about = .99; // equal couplings differ by round-off
        std::vector<double> row(value.begin() + start[node], value.begin() + start[node + 1]);
        if (row.size() < least)
          return round_off;
        std::nth_element(row.begin(), row.begin() + least - 1, row.end(), std::greater<double>());
        return std::max(round_off, std::min(about * row[least - 1], strong));
      }
    };

    /** Calls @p visit for all nodes strongly coupled to @p node, including @p node, with the coupling. */
    template <class Visit>
    void for_neighbours(const Couplings &K, const unsigned int node, const Visit &visit)
    {
      for (std::size_t k = K.start[node]; k < K.start[node + 1]; ++k)
        if (K.value[k] > K.limit[node])
          visit(K.column[k], K.value[k]);
    }

    /** Returns the group of each node. @p seeds receives the central nodes of the groups. */
    std::vector<unsigned int> groups(const Couplings &K, const std::vector<bool> &held,
                                     std::vector<unsigned int> &seeds)
    {
      const unsigned int        n = K.n_rows();
      std::vector<unsigned int> group(n, none);
      const auto                gather = [&](const unsigned int i)
      {
        const unsigned int number = seeds.size();
        seeds.push_back(i);
        group[i] = number;
        for_neighbours(K, i,
                       [&](const unsigned int j, double)
                       {
                         if (group[j] == none)
                           group[j] = number;
                       });
      };
      for (unsigned int i = 0; i < n; ++i)
      {
        bool alone = !held[i] && group[i] == none;
        if (alone)
          for_neighbours(K, i, [&](const unsigned int j, double) { alone = alone && group[j] == none; });
        if (alone)
          gather(i);
      }
      const std::vector<unsigned int> first = group;
      for (unsigned int i = 0; i < n; ++i)
        if (double most = 0.; !held[i] && first[i] == none)
          for_neighbours(K, i,
                         [&](const unsigned int j, const double part)
                         {
                           if (first[j] != none && part > most)
                           {
                             most = part;
                             group[i] = first[j];
                           }
                         });
      for (unsigned int i = 0; i < n; ++i)
        if (!held[i] && group[i] == none)
          gather(i);
      return group;
    }
  } // namespace

  RockAggregates::RockAggregates(const BlockSparseMatrix &stiffness, const std::vector<Vector3> &points,
                                 const std::vector<bool> &held, const double strong)
      : group(groups(Couplings(stiffness, held, strong), held, seeds)), arm(points.size(), Vector3{})
  {
    for (unsigned int i = 0; i < group.size(); ++i)
      if (group[i] != none)
      {
        members.resize(std::max<std::size_t>(members.size(), group[i] + 1));
        members[group[i]].push_back(i);
      }
    for (const auto &nodes : members)
    {
      Vector3 middle{};
      for (const unsigned int i : nodes)
        for (unsigned int c = 0; c < 3; ++c)
          middle[c] += points[i][c] / nodes.size();
      double largest = 0.;
      for (const unsigned int i : nodes)
      {
        for (unsigned int c = 0; c < 3; ++c)
          arm[i][c] = points[i][c] - middle[c];
        largest = std::max(largest, norm(arm[i]));
      }
      centre.push_back(middle);
      size.push_back(largest > 0. ? largest : 1.);
      for (const unsigned int i : nodes)
        for (double &x : arm[i])
          x /= size.back();
    }
  }

  Vector3 RockAggregates::displacement(const unsigned int node, const RigidMotion &m) const
  {
    const Vector3 &r = arm[node];
    return {{m[0] + m[4] * r[2] - m[5] * r[1], m[1] + m[5] * r[0] - m[3] * r[2],
             m[2] + m[3] * r[1] - m[4] * r[0]}};
  }

  void RockAggregates::add_force(const unsigned int node, const Vector3 &f, RigidMotion &sum) const
  {
    const Vector3 &r = arm[node];
    for (unsigned int c = 0; c < 3; ++c)
      sum[c] += f[c];
    sum[3] += r[1] * f[2] - r[2] * f[1];
    sum[4] += r[2] * f[0] - r[0] * f[2];
    sum[5] += r[0] * f[1] - r[1] * f[0];
  }

  std::vector<RigidMotion> RockAggregates::rigid(const unsigned int mode) const
  {
    Vector3 middle{};
    for (const Vector3 &p : centre)
      for (unsigned int c = 0; c < 3; ++c)
        middle[c] += p[c] / n();
    double whole = 0.;
    for (unsigned int a = 0; a < n(); ++a)
      whole = std::max({whole, size[a], norm(centre[a] - middle)});
    std::vector<RigidMotion> result(n(), RigidMotion{});
    for (unsigned int a = 0; a < n(); ++a)
      if (mode < 3)
        result[a][mode] = 1.;
      else
      {
        const unsigned int c = mode - 3, d = (c + 1) % 3, e = (c + 2) % 3;
        result[a][d] = -(centre[a][e] - middle[e]) / whole;
        result[a][e] = (centre[a][d] - middle[d]) / whole;
        result[a][mode] = size[a] / whole;
      }
    return result;
  }

  namespace
  {
    /** Displacements or forces at some nodes for the six rigid body motions of an aggregate. */
    struct Patch
    {
      std::vector<unsigned int>           nodes;
      std::vector<std::array<double, 18>> value; ///< per node, 3x6 row by row
    };

    /** Adds a x to y. @p transposed: a^T x. */
    template <bool transposed>
    void add_product(const Matrix3 &a, const std::array<double, 18> &x, std::array<double, 18> &y)
    {
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int d = 0; d < 3; ++d)
        {
          const double factor = transposed ? a[3 * d + c] : a[3 * c + d];
          for (unsigned int m = 0; m < 6; ++m)
            y[6 * c + m] += factor * x[6 * d + m];
        }
    }

    class PatchProducts
    {
    public:
      PatchProducts(const RockAggregates &aggregates, const RockSmoothing &smoothing)
          : aggregates(aggregates), smoothing(smoothing), at(smoothing.stiffness.n_rows(), none)
      {
      }

      void add_row(const unsigned int aggregate, std::vector<CoarseBlock> &blocks)
      {
        const Patch x = smoothed(rigid(aggregate)), y = multiply(x);
        Patch       z = multiply(scaled(y));
        for (std::size_t i = 0; i < z.nodes.size(); ++i)
          for (unsigned int k = 0; k < 18; ++k)
            z.value[i][k] += i < y.nodes.size() ? y.value[i][k] : 0.;
        std::map<unsigned int, std::array<double, 36>> row;
        for (std::size_t i = 0; i < z.nodes.size(); ++i)
        {
          auto &block = row[aggregates.of_node(z.nodes[i])];
          for (unsigned int m = 0; m < 6; ++m)
          {
            RigidMotion force{};
            aggregates.add_force(z.nodes[i], {{z.value[i][m], z.value[i][6 + m], z.value[i][12 + m]}}, force);
            for (unsigned int k = 0; k < 6; ++k)
              block[6 * m + k] += force[k];
          }
        }
        for (const auto &[column, block] : row)
        {
          blocks.push_back({aggregate, column, {}});
          std::copy(block.begin(), block.end(), blocks.back().value.begin());
        }
      }

    private:
      Patch rigid(const unsigned int aggregate) const
      {
        Patch patch;
        for (const unsigned int node : aggregates.nodes(aggregate))
        {
          patch.nodes.push_back(node);
          patch.value.emplace_back();
          for (unsigned int m = 0; m < 6; ++m)
          {
            RigidMotion motion{};
            motion[m] = 1.;
            const Vector3 u = aggregates.displacement(node, motion);
            for (unsigned int c = 0; c < 3; ++c)
              patch.value.back()[6 * c + m] = u[c];
          }
        }
        return patch;
      }

      /** Returns K x. The nodes of x come first. */
      Patch multiply(const Patch &x)
      {
        constexpr double         nothing = 1e-28; // the square of round-off: 1e-14
        const BlockSparseMatrix &K = smoothing.stiffness;
        Patch                    y;
        y.nodes = x.nodes;
        for (unsigned int i = 0; i < x.nodes.size(); ++i)
          at[x.nodes[i]] = i;
        y.value.resize(x.nodes.size());
        for (unsigned int i = 0; i < x.nodes.size(); ++i)
        {
          const unsigned int node = x.nodes[i];
          ensure(K.start[node] < K.start[node + 1], "A row of the rock is not on this rank.");
          double largest = 0.;
          for (std::size_t k = K.start[node]; k < K.start[node + 1]; ++k)
            largest = std::max(largest, square(K.value[k]));
          for (std::size_t k = K.start[node]; k < K.start[node + 1]; ++k)
          {
            const unsigned int j = K.column[k];
            if (aggregates.of_node(j) == none || square(K.value[k]) <= nothing * largest)
              continue;
            if (at[j] == none)
            {
              at[j] = y.nodes.size();
              y.nodes.push_back(j);
              y.value.emplace_back();
            }
            add_product<true>(K.value[k], x.value[i], y.value[at[j]]);
          }
          if (const auto spring = smoothing.springs.find(node); spring != smoothing.springs.end())
            add_product<true>(spring->second, x.value[i], y.value[i]);
        }
        for (const unsigned int node : y.nodes)
          at[node] = none;
        return y;
      }

      /** Returns - damping D^-1 x. */
      Patch scaled(const Patch &x) const
      {
        Patch y;
        y.nodes = x.nodes;
        y.value.resize(x.nodes.size());
        for (std::size_t i = 0; i < x.nodes.size(); ++i)
        {
          Matrix3 factor = smoothing.inverse[x.nodes[i]];
          for (double &a : factor)
            a *= -smoothing.damping;
          add_product<false>(factor, x.value[i], y.value[i]);
        }
        return y;
      }

      Patch smoothed(const Patch &x)
      {
        Patch y = scaled(multiply(x));
        for (std::size_t i = 0; i < x.nodes.size(); ++i)
          for (unsigned int k = 0; k < 18; ++k)
            y.value[i][k] += x.value[i][k];
        return y;
      }

      const RockAggregates     &aggregates;
      const RockSmoothing      &smoothing;
      std::vector<unsigned int> at; ///< index of each node in the current patch
    };
  } // namespace

  std::vector<CoarseBlock> coarse_rows(const RockAggregates &aggregates, const RockSmoothing &smoothing,
                                       const std::vector<unsigned int> &wanted)
  {
    constexpr std::size_t                 per_task = 64;
    const std::size_t                     n_tasks = (wanted.size() + per_task - 1) / per_task;
    std::vector<std::vector<CoarseBlock>> parts(n_tasks);
    for_each_parallel(static_cast<int>(n_tasks),
                      [&](const int task)
                      {
                        PatchProducts products(aggregates, smoothing);
                        for (std::size_t i = task * per_task;
                             i < std::min(wanted.size(), (task + 1) * per_task); ++i)
                          products.add_row(wanted[i], parts[task]);
                      });
    std::size_t n = 0;
    for (const auto &part : parts)
      n += part.size();
    std::vector<CoarseBlock> result;
    result.reserve(n);
    for (auto &part : parts)
    {
      result.insert(result.end(), part.begin(), part.end());
      std::vector<CoarseBlock>().swap(part);
    }
    return result;
  }
} // namespace Voussoir
