// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/mesh/arch_rows.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace Voussoir
{
  namespace
  {
    constexpr double round_off = 1e-9; ///< relative; it must not distinguish mirror images

    class PlaneBuilder
    {
    public:
      PlaneBuilder(const ArchColumns &columns, const int n_up, const std::vector<bool> &refused)
          : columns(columns), refused(refused), n(columns.s.size()), is_middle(n, false)
      {
        for (const auto &base : columns.base)
          height.push_back(columns.top - std::accumulate(base.begin(), base.end(), 0.) / base.size());
        deepest = std::max_element(height.begin(), height.end()) - height.begin();
        h = height[deepest] / n_up;
        count_rows(n_up);
        choose_middles();
        add_columns();
        for (int i = 0; i + 1 < n; i += is_middle[i + 1] ? 2 : 1)
          add_strip(i, is_middle[i + 1]);
      }

      ArchPlane plane;

    private:
      void count_rows(const int n_up)
      {
        const auto nearest = [&, parity = n_up % 2](const double x) // number with this parity
        {
          return std::clamp<int>(2 * std::lround((x - parity) / 2. - round_off) + parity, 2 - parity, n_up);
        };
        std::vector<int> least; // for rows of at most 2 h
        for (const double H : height)
        {
          rows.push_back(nearest(H / h));
          least.push_back(nearest(H / h / 2. + 1.));
        }
        const auto limit = [&](const int i, const int beside)
        {
          rows[i] = std::min(rows[i], rows[beside] + 2);
          least[i] = std::max(least[i], least[beside] - 2);
        };
        for (int i = 1; i < n; ++i)
          limit(i, i - 1);
        for (int i = n - 1; i > 0; --i)
          limit(i - 1, i);
        for (int i = 0; i < n; ++i)
          rows[i] = std::max(rows[i], least[i]);
      }

      bool can_be_middle(const int i) const
      {
        return i > 0 && i + 1 < n && !refused[i] && columns.monolith[i - 1] == columns.monolith[i] &&
               std::abs(rows[i + 1] - rows[i - 1]) == 2 && !is_middle[i - 1] && !is_middle[i] &&
               !is_middle[i + 1];
      }

      /** Chooses the middle columns of wide templates, from the deepest column to the banks: one of the two columns
       * between which the number of rows falls, if possible the one whose height is nearer to the mean number. */
      void choose_middles()
      {
        for (const int side : {1, -1})
          for (int i = deepest, next = i + side; next >= 0 && next < n; i = next, next += side)
            if (rows[i] != rows[next])
            {
              const auto error = [&](const int column)
              { return std::abs(height[column] / h - .5 * (rows[i] + rows[next])); };
              // A level strip may be the axis of symmetry, and belongs to no template.
              const bool can_be_inner = can_be_middle(i) && height[i - side] > (1. + round_off) * height[i];
              if (can_be_middle(next) && !(can_be_inner && error(i) < error(next) - round_off))
                is_middle[next] = true;
              else if (can_be_inner)
                is_middle[i] = true;
            }
      }

      /** Returns the upper end of row @p k of column @p i as a share of the height. The lowest three rows are equal. */
      double end_of_row(const int k, const int i) const
      {
        const int    m = rows[i], band = std::min(m, 3);
        const double row = std::clamp(h / height[i], 1. / (m + .5 * band), 1. / (m - .4 * band));
        return k < band ? (1. - (m - band) * row) * k / band : 1. - (m - k) * row;
      }

      unsigned int add_node(const double s, const std::vector<double> &z)
      {
        plane.s.push_back(s);
        plane.z.push_back(z);
        return plane.s.size() - 1;
      }

      /** Adds the weighted mean of nodes. */
      unsigned int add_mean(const std::vector<std::pair<unsigned int, double>> &weights)
      {
        double              s = 0.;
        std::vector<double> z(columns.base[0].size(), 0.);
        for (const auto &[node, weight] : weights)
        {
          s += weight * plane.s[node];
          for (std::size_t l = 0; l < z.size(); ++l)
            z[l] += weight * plane.z[node][l];
        }
        return add_node(s, z);
      }

      void add_columns()
      {
        plane.columns.resize(n);
        for (int i = 0; i < n; ++i)
          for (int k = 0; k <= (is_middle[i] ? 0 : rows[i]); ++k)
          {
            std::vector<double> z;
            for (const double base : columns.base[i])
              z.push_back(base + (columns.top - base) * end_of_row(k, i));
            plane.columns[i].push_back(add_node(columns.s[i], z));
          }
        for (int i = 0; i < n; ++i)
          if (is_middle[i]) // above its base at the means of its neighbours, counted from the crest
          {
            const auto &a = plane.columns[i - 1], &b = plane.columns[i + 1];
            for (auto k = std::min(a.size(), b.size()) - 1; k > 0; --k)
            {
              plane.columns[i].push_back(add_mean({{a[a.size() - k], .5}, {b[b.size() - k], .5}}));
              plane.s.back() = columns.s[i];
            }
          }
      }

      /** Adds the elements between the column @p first and the next one, or the second next one. */
      void add_strip(const int first, const bool is_wide)
      {
        const int   last = first + (is_wide ? 2 : 1), fall = std::abs(rows[last] - rows[first]);
        const bool  falls = rows[first] > rows[last];
        const auto &L = plane.columns[falls ? first : last], &R = plane.columns[falls ? last : first],
                   &M = is_wide ? plane.columns[first + 1] : R; // L: the column with more rows
        using Node = unsigned int;
        const auto add = [&](const Node a, const Node b, const Node c, const Node d)
        {
          const std::array<Node, 4> nodes = {a, b, c, d}, mirrored = {b, a, d, c};
          plane.quads.push_back(
              {falls ? nodes : mirrored, columns.monolith[first], is_wide ? first + 1u : 0u});
        };
        if (fall > 0)
        {
          constexpr double p = 3. / 11., q = 1. / 11., third = 1. / 3.;
          const Node       B = is_wide ? add_mean({{L[2], p}, {R[0], p}, {M[1], p}, {L[1], q}, {M[0], q}})
                                       : add_mean({{L[2], .5}, {R[0], .2}, {R[1], .3}});
          const Node       A = is_wide ? add_mean({{L[1], third}, {M[0], third}, {B, third}})
                                       : add_mean({{L[1], .5}, {R[0], .3}, {R[1], .2}});
          add(L[0], M[0], A, L[1]);
          add(L[1], A, B, L[2]);
          add(L[2], B, M[1], L[3]);
          is_wide ? add(M[0], R[0], B, A) : add(A, R[0], R[1], B);
          if (is_wide)
            add(B, R[0], R[1], M[1]);
        }
        for (std::size_t k = fall > 0 ? 1 : 0; k + 1 < R.size(); ++k)
        {
          add(L[k + fall], M[k], M[k + 1], L[k + fall + 1]);
          if (is_wide)
            add(M[k], R[k], R[k + 1], M[k + 1]);
        }
      }

      const ArchColumns       &columns;
      const std::vector<bool> &refused;
      const int                n;         // number of columns
      std::vector<bool>        is_middle; // of a wide template
      std::vector<double>      height;    // of the columns [m]
      std::vector<int>         rows;      // of the columns
      int                      deepest;   // column
      double                   h;         // wanted height of a row [m]
    };
  } // namespace

  ArchPlane rows_from_crest(const ArchColumns &columns, const int n_up, const std::vector<bool> &refused)
  {
    return PlaneBuilder(columns, n_up, refused).plane;
  }
} // namespace Voussoir
