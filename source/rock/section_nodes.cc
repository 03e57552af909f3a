// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/rock/section_nodes.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Voussoir
{
  SectionNodes::SectionNodes(const RockModel &section, const unsigned int direction, const RockModel &rock)
      : direction(direction)
  {
    const unsigned int   across = 1 - direction;
    double               size = 0., ground = std::numeric_limits<double>::max();
    std::vector<Vector3> places;
    for (Vector3 p : section.points)
    {
      size = std::max(size, std::abs(p[2] - section.points.front()[2]));
      p[direction] = 0.;
      places.push_back(p);
    }
    tolerance = 1e-6 * size;
    finder = std::make_unique<PointFinder>(places, tolerance);
    for (const RockColumn &column : rock.columns)
      ground = std::min(ground, column.z.back());
    const auto [first, last] =
        std::minmax_element(rock.points.begin(), rock.points.end(),
                            [&](const Vector3 &a, const Vector3 &b) { return a[across] < b[across]; });
    for (unsigned int i = 0; i < places.size(); ++i)
      if (const double y = places[i][across], z = places[i][2];
          z < ground - tolerance && y > (*first)[across] - tolerance && y < (*last)[across] + tolerance)
        rows.push_back({z, y, static_cast<int>(i)});
    std::sort(rows.begin(), rows.end(), [](const Node &a, const Node &b) { return a.z < b.z; });
    for (auto begin = rows.begin(); begin != rows.end();)
    {
      const auto end =
          std::find_if(begin, rows.end(), [&](const Node &node) { return node.z > begin->z + tolerance; });
      std::sort(begin, end, [](const Node &a, const Node &b) { return a.across < b.across; });
      begin = end;
    }
  }

  std::optional<SectionNodes::Place> SectionNodes::find(Vector3 place) const
  {
    const double y = place[1 - direction], z = place[2];
    place[direction] = 0.;
    Place result;
    if (const unsigned int node = finder->find(place); node != PointFinder::none)
    {
      result.node[0] = static_cast<int>(node);
      return result;
    }
    const auto begin = std::partition_point(rows.begin(), rows.end(),
                                            [&](const Node &node) { return node.z < z - tolerance; });
    const auto end =
        std::partition_point(begin, rows.end(), [&](const Node &node) { return node.z < z + tolerance; });
    const auto above = std::partition_point(begin, end, [&](const Node &node) { return node.across < y; });
    if (end - begin < 4 || above == begin || above == end)
      return {};
    const auto first = begin + std::clamp<std::ptrdiff_t>(above - begin - 2, 0, end - begin - 4);
    for (unsigned int i = 0; i < 4; ++i)
    {
      result.node[i] = first[i].number;
      result.weight[i] = 1.;
      for (unsigned int j = 0; j < 4; ++j)
        if (j != i)
          result.weight[i] *= (y - first[j].across) / (first[i].across - first[j].across);
    }
    return result;
  }
} // namespace Voussoir
