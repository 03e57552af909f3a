// SPDX-License-Identifier: GPL-3.0-or-later
// Points at the same place, found within a tolerance.

#include "column.h"

#include <voussoir/mesh/coincident.h>

namespace
{
  using namespace Voussoir;

  void check(const std::string &what, const bool good)
  {
    Columns::report(what, 0., "-", good);
  }

  void grid()
  {
    constexpr double                   h = 1.5e-4, tolerance = 1e-4; // roundings of one tolerance meet
    std::vector<std::array<double, 3>> points;
    for (unsigned int i = 0; i < 1000; ++i)
      points.push_back({{h * (i % 10), 1e3 + h * (i / 10 % 10), h * (i / 100)}});
    const PointFinder finder(points, tolerance);
    bool              all = true, beside = true, nearest = true;
    for (unsigned int i = 0; i < points.size(); ++i)
    {
      auto moved = points[i];
      for (unsigned int c = 0; c < 3; ++c)
        moved[c] += (i >> c) % 2 ? .3 * tolerance : -.3 * tolerance;
      all = all && finder.find(moved) == i;
      const PointFinder::Nearest found = finder.nearest(moved);
      nearest = nearest && found.number == i && std::abs(found.distance - std::sqrt(.27) * tolerance) < 1e-12;
      moved[2] = -1.1 * tolerance;
      beside = beside && finder.find(moved) == PointFinder::none;
    }
    check("each of 1000 points is found by a place beside it", all);
    check("  and none by one farther than the tolerance", beside);
    check("  at its distance", nearest);
    check("  and of the far places the nearest is known", finder.nearest({{-3., 1e3, 0.}}).distance == 3.);
    check("there is none in an empty set",
          PointFinder(std::vector<std::array<double, 3>>(), 1.).find({{0., 0., 0.}}) == PointFinder::none);
  }
} // namespace

int main()
{
  return Columns::run_all({grid});
}
