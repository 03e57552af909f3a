// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/numerics/rtree.h>

#include <voussoir/mesh/coincident.h>

#include <iterator>
#include <limits>

namespace Voussoir
{
  using dealii::Point;

  struct PointFinder::Tree
  {
    using Entry = std::pair<Point<3>, unsigned int>;
    dealii::RTree<Entry> entries;
  };

  PointFinder::PointFinder(const std::vector<std::array<double, 3>> &points, const double tolerance)
      : tree(std::make_unique<Tree>()), tolerance(tolerance)
  {
    std::vector<Tree::Entry> entries;
    for (unsigned int i = 0; i < points.size(); ++i)
      entries.emplace_back(Point<3>(points[i][0], points[i][1], points[i][2]), i);
    tree->entries = dealii::pack_rtree(entries);
  }

  PointFinder::~PointFinder() = default;

  PointFinder::Nearest PointFinder::nearest(const std::array<double, 3> &place) const
  {
    const Point<3>           wanted(place[0], place[1], place[2]);
    std::vector<Tree::Entry> found;
    tree->entries.query(boost::geometry::index::nearest(wanted, 1), std::back_inserter(found));
    if (found.empty())
      return {none, std::numeric_limits<double>::infinity()};
    return {found[0].second, found[0].first.distance(wanted)};
  }

  std::vector<unsigned int> PointFinder::all_nearest(const std::array<double, 3> &place,
                                                     const double                 slack) const
  {
    const Point<3>           wanted(place[0], place[1], place[2]);
    const double             least = nearest(place).distance;
    std::vector<Tree::Entry> found;
    tree->entries.query(boost::geometry::index::nearest(wanted, 8), std::back_inserter(found));
    std::vector<unsigned int> result;
    for (const auto &[point, number] : found)
      if (point.distance(wanted) <= least + slack)
        result.push_back(number);
    return result;
  }

  unsigned int PointFinder::find(const std::array<double, 3> &place) const
  {
    const Nearest found = nearest(place);
    return found.distance <= tolerance ? found.number : none;
  }
} // namespace Voussoir
