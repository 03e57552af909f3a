// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/foundation/base_nodes.h>
#include <voussoir/mesh/coincident.h>
#include <voussoir/solid/solid_grid.h>
#include <voussoir/solid/solid_model.h>

#include <algorithm>
#include <map>
#include <set>

namespace Voussoir
{
  namespace
  {
    /** Largest distance of a base node of the dam from its rock node, relative to the base's size [-]. */
    constexpr double coincidence = 1e-6;

    /** Returns the thickness of the footings, which lie in the rock, or 0 without footings [m]. */
    double footing_thickness(const SolidModel &dam)
    {
      for (const auto &cell : dam.grid->dof_handler.active_cell_iterators())
        if (is_footing(static_cast<int>(cell->material_id())))
          return cell->minimum_vertex_distance();
      return 0.;
    }

    double size_of(const std::vector<std::array<double, 3>> &points)
    {
      double size = 0.;
      if (points.empty())
        return size;
      for (unsigned int d = 0; d < 3; ++d)
      {
        const auto by_component = [d](const auto &a, const auto &b) { return a[d] < b[d]; };
        const auto ends = std::minmax_element(points.begin(), points.end(), by_component);
        size = std::max(size, (*ends.second)[d] - (*ends.first)[d]);
      }
      return size;
    }
  } // namespace

  std::vector<BaseNode> find_base_nodes(const SolidModel                         &dam,
                                        const std::vector<std::array<double, 3>> &points,
                                        const std::string                        &source)
  {
    std::vector<unsigned int>          equations;
    std::vector<std::array<double, 3>> base;
    for (unsigned int i = 0; i < dam.n_nodes(); ++i)
      if (dam.on_surface(i, PhysicalId::base))
      {
        equations.push_back(dam.equation[i]);
        base.push_back(dam.points[i]);
      }
    std::map<unsigned int, std::set<unsigned int>> on_rock;
    const double      tolerance = std::max(coincidence * size_of(base), 1.01 * footing_thickness(dam));
    const PointFinder finder(points, tolerance);
    std::vector<std::array<double, 3>> lost;
    for (std::size_t i = 0; i < base.size(); ++i)
      if (const unsigned int rock = finder.find(base[i]); rock != PointFinder::none)
        on_rock[rock].insert(equations[i]);
      else
        lost.push_back(base[i]);
    if (!lost.empty())
      throw InputError("mesh " + source + ": the dam's base and the rock must share their nodes, but " +
                       std::to_string(lost.size()) + " nodes of the base are not in the rock, the first at " +
                       place(lost[0]) + ". Merge the nodes of dam and rock there (gmsh: Coherence).");
    std::vector<BaseNode> base_nodes;
    for (const auto &base_node : on_rock)
      base_nodes.push_back({base_node.first, {base_node.second.begin(), base_node.second.end()}});
    return base_nodes;
  }

  std::vector<unsigned int> rock_nodes(const std::vector<BaseNode> &base_nodes)
  {
    std::vector<unsigned int> result;
    for (const BaseNode &base_node : base_nodes)
      result.push_back(base_node.rock);
    return result;
  }

  DamNodes::DamNodes(const std::vector<BaseNode> &base_nodes)
  {
    std::vector<std::pair<unsigned int, unsigned int>> dam_nodes;
    for (unsigned int i = 0; i < base_nodes.size(); ++i)
      for (const unsigned int dam_node : base_nodes[i].nodes)
        dam_nodes.push_back({dam_node, i});
    std::sort(dam_nodes.begin(), dam_nodes.end());
    for (const auto &[dam_node, i] : dam_nodes)
    {
      node.push_back(dam_node);
      base_node.push_back(i);
    }
  }

  void DamNodes::mark(Structure &structure) const
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

  BlockSparseMatrix DamNodes::matrix(const BlockSparseMatrix &R) const
  {
    std::vector<std::vector<unsigned int>> dam_nodes(R.n_rows()), columns(base_node.size());
    for (unsigned int i = 0; i < base_node.size(); ++i)
      dam_nodes[base_node[i]].push_back(i);
    const auto each = [&](const auto &action)
    {
      for (unsigned int i = 0; i < base_node.size(); ++i)
        for (std::size_t k = R.start[base_node[i]]; k < R.start[base_node[i] + 1]; ++k)
          for (const unsigned int j : dam_nodes[R.column[k]])
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
