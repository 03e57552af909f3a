// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/foundation/feet.h>
#include <voussoir/mesh/coincident.h>

#include <algorithm>
#include <map>
#include <set>

namespace Voussoir
{
  namespace
  {
    /** Largest distance of a base node of the dam from its rock node, relative to the base's size [-]. */
    constexpr double coincidence = 1e-6;

    double size_of(const std::vector<std::array<double, 3>> &points)
    {
      double size = 0.;
      for (unsigned int d = 0; d < 3; ++d)
      {
        const auto by_component = [d](const auto &a, const auto &b) { return a[d] < b[d]; };
        const auto ends = std::minmax_element(points.begin(), points.end(), by_component);
        size = std::max(size, (*ends.second)[d] - (*ends.first)[d]);
      }
      return size;
    }
  } // namespace

  std::vector<Foot> find_feet(const SolidModel &dam, const std::vector<std::array<double, 3>> &points,
                              const std::string &source)
  {
    std::vector<unsigned int>          equations;
    std::vector<std::array<double, 3>> base;
    for (unsigned int i = 0; i < dam.n_nodes(); ++i)
      if (dam.on_surface(i, PhysicalId::base))
      {
        equations.push_back(dam.equation[i]);
        base.push_back({{dam.points[i][0], dam.points[i][1], dam.points[i][2]}});
      }
    std::map<unsigned int, std::set<unsigned int>> on_rock;
    const PointFinder finder(points, base.empty() ? 0. : coincidence * size_of(base));
    unsigned int      n_lost = 0;
    for (std::size_t i = 0; i < base.size(); ++i)
      if (const unsigned int rock = finder.find(base[i]); rock != PointFinder::none)
        on_rock[rock].insert(equations[i]);
      else
        ++n_lost;
    if (n_lost > 0)
      throw InputError(source + ": the dam's base and the rock must share their nodes, but " +
                       std::to_string(n_lost) + " nodes of the base are not in the rock. Correct the mesh.");
    std::vector<Foot> feet;
    for (const auto &foot : on_rock)
      feet.push_back({foot.first, {foot.second.begin(), foot.second.end()}});
    return feet;
  }

  StandingNodes::StandingNodes(const std::vector<Foot> &feet)
  {
    std::vector<std::pair<unsigned int, unsigned int>> standing;
    for (unsigned int i = 0; i < feet.size(); ++i)
      for (const unsigned int on_foot : feet[i].nodes)
        standing.push_back({on_foot, i});
    std::sort(standing.begin(), standing.end());
    for (const auto &[on_foot, i] : standing)
    {
      node.push_back(on_foot);
      foot.push_back(i);
    }
  }

  void StandingNodes::mark(Structure &structure) const
  {
    for (Body &body : structure.bodies)
    {
      for (const unsigned int i : node)
        if (i >= body.first_node && i < body.first_node + body.n_nodes())
          body.interface.push_back(i - body.first_node);
      std::sort(body.interface.begin(), body.interface.end());
      body.interface.erase(std::unique(body.interface.begin(), body.interface.end()), body.interface.end());
    }
  }

  BlockSparseMatrix StandingNodes::matrix(const BlockSparseMatrix &R) const
  {
    std::vector<std::vector<unsigned int>> standing(R.n_rows()), columns(foot.size());
    for (unsigned int i = 0; i < foot.size(); ++i)
      standing[foot[i]].push_back(i);
    const auto each = [&](const auto &action)
    {
      for (unsigned int i = 0; i < foot.size(); ++i)
        for (std::size_t k = R.start[foot[i]]; k < R.start[foot[i] + 1]; ++k)
          for (const unsigned int j : standing[R.column[k]])
            action(i, j, R.value[k]);
    };
    each([&](const unsigned int i, const unsigned int j, const Matrix3 &) { columns[i].push_back(j); });
    for (auto &row : columns)
      std::sort(row.begin(), row.end());
    BlockSparseMatrix result(columns);
    each([&](const unsigned int i, const unsigned int j, const Matrix3 &block) { result.add(i, j, block); });
    return result;
  }
} // namespace Voussoir
