// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/foundation/feet.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Voussoir
{
  namespace
  {
    using Key = std::array<long long, 3>;

    template <class Point> Key key_of(const Point &p)
    {
      return {{std::llround(1e4 * p[0]), std::llround(1e4 * p[1]), std::llround(1e4 * p[2])}};
    }
  } // namespace

  std::vector<Foot> find_feet(const SolidModel &dam, const std::vector<std::array<double, 3>> &points,
                              const std::string &source)
  {
    std::map<Key, std::vector<unsigned int>> base;
    for (unsigned int i = 0; i < dam.n_nodes(); ++i)
      if (dam.on_surface(i, PhysicalId::base))
        base[key_of(dam.points[i])].push_back(dam.equation[i]);
    std::vector<Foot> feet;
    for (unsigned int i = 0; i < points.size(); ++i)
      if (const auto found = base.find(key_of(points[i])); found != base.end())
      {
        std::vector<unsigned int> &nodes = found->second;
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        feet.push_back({i, nodes});
      }
    if (feet.size() != base.size())
      throw InputError(source + ": the dam's base and the rock must share their nodes; " +
                       std::to_string(base.size() - feet.size()) + " nodes of the base are not in the rock.");
    return feet;
  }
} // namespace Voussoir
