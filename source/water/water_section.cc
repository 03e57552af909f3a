// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/water/water_section.h>
#include <voussoir/water/water_size.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace Voussoir
{
  namespace
  {
    using Edge = std::pair<unsigned int, unsigned int>;

    Point2 projected(const Vector3 &x)
    {
      return {x[1], x[2]};
    }

    double distance(const Point2 &a, const Point2 &b)
    {
      return std::hypot(b[0] - a[0], b[1] - a[1]);
    }

    double cross(const Point2 &o, const Point2 &a, const Point2 &b)
    {
      return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
    }

    Point2 between(const Point2 &a, const Point2 &b, const double t)
    {
      return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
    }

    /** Throws InputError for a face that is folded, as seen along the river. */
    void check_folds(const std::vector<WetQuad> &faces)
    {
      int sign = 0;
      for (const WetQuad &face : faces)
        for (unsigned int k = 0; k < 4; ++k)
        {
          const double area = cross(projected(face.corners[k]), projected(face.corners[(k + 1) % 4]),
                                    projected(face.corners[(k + 3) % 4]));
          const int    of_corner = area > 0. ? 1 : -1;
          if (sign != 0 && of_corner != sign)
            throw InputError(
                "Mesh of the water: the upstream face is folded as seen along the river, near y = " +
                number_text(face.corners[k][1]) + " m, z = " + number_text(face.corners[k][2]) +
                " m. The water mesh is extruded from this face. Use a water mesh of your own, or set Reservoir/Model to Westergaard.");
          sign = of_corner;
        }
    }

    /** Returns the outline of the faces as a closed chain of points, counter-clockwise. Corners are merged by
     * position. */
    std::vector<Point2> outline(const std::vector<WetQuad> &faces)
    {
      double size = 0.;
      for (const WetQuad &face : faces)
        size = std::max({size, std::abs(face.corners[0][1]), std::abs(face.corners[0][2])});
      std::map<std::pair<long, long>, unsigned int> number;
      std::vector<Point2>                           points;
      const auto                                    node = [&](const Vector3 &x)
      {
        const double unit = 1e-7 * size;
        const auto   found =
            number.emplace(std::pair(std::lround(x[1] / unit), std::lround(x[2] / unit)), points.size());
        if (found.second)
          points.push_back(projected(x));
        return found.first->second;
      };
      std::map<Edge, int> edges; // with direction
      for (WetQuad face : faces)
      {
        if (cross(projected(face.corners[0]), projected(face.corners[1]), projected(face.corners[3])) < 0.)
          std::reverse(face.corners.begin(), face.corners.end());
        for (unsigned int k = 0; k < 4; ++k)
        {
          const Edge edge(node(face.corners[k]), node(face.corners[(k + 1) % 4]));
          if (edge.first == edge.second)
            continue;
          if (const auto other = edges.find({edge.second, edge.first}); other != edges.end())
            edges.erase(other);
          else
            edges[edge] = 1;
        }
      }
      std::map<unsigned int, unsigned int> next;
      for (const auto &edge : edges)
        next[edge.first.first] = edge.first.second;
      std::vector<Point2> chain;
      unsigned int        at = next.begin()->first;
      do
      {
        chain.push_back(points[at]);
        at = next.at(at);
      } while (at != next.begin()->first && chain.size() <= next.size());
      if (chain.size() != next.size())
        throw InputError("Mesh of the water: the upstream face has more than one outline. Make the surface "
                         "\"upstream\" one connected face without holes.");
      return chain;
    }

    /** Returns the part of the outline below the level, from one end of the water line to the other: the end with the
     * larger y is the last one. */
    std::vector<Point2> bank_of(std::vector<Point2> closed, const double level)
    {
      const std::size_t n = closed.size();
      double            low = closed[0][1], high = low;
      for (const Point2 &point : closed)
        low = std::min(low, point[1]), high = std::max(high, point[1]);
      for (Point2 &point : closed) // a full reservoir, without the round-off of the mesh
        if (std::abs(point[1] - level) < 2e-6 * (high - low))
          point[1] = level;
      std::vector<std::vector<Point2>> parts;
      std::size_t                      first = 0; // a point above the level
      while (first < n && closed[first][1] < level)
        ++first;
      if (first == n)
        throw InputError("Mesh of the water: the water level of " + number_text(level) +
                         " m is above the upstream face of the dam. Lower Reservoir/Water level.");
      for (std::size_t k = 0; k < n; ++k)
      {
        const Point2 &a = closed[(first + k) % n], &b = closed[(first + k + 1) % n];
        const bool    a_below = a[1] < level, b_below = b[1] < level;
        if (!a_below && b_below)
          parts.push_back({between(a, b, (level - a[1]) / (b[1] - a[1]))});
        if (b_below)
          parts.back().push_back(b);
        if (a_below && !b_below)
          parts.back().push_back(between(a, b, (level - a[1]) / (b[1] - a[1])));
      }
      if (parts.size() != 1)
        throw InputError("Mesh of the water: the water level of " + number_text(level) +
                         (parts.empty() ? " m is below the upstream face of the dam."
                                        : " m divides the upstream face into several parts.") +
                         " Correct Reservoir/Water level.");
      if (parts[0].front()[0] > parts[0].back()[0])
        std::reverse(parts[0].begin(), parts[0].end());
      return parts[0];
    }

    /** Chain of points with the arc length as coordinate. */
    class Bank
    {
    public:
      explicit Bank(std::vector<Point2> chain) : points(std::move(chain)), at_point(1, 0.)
      {
        for (std::size_t k = 1; k < points.size(); ++k)
          at_point.push_back(at_point.back() + Voussoir::distance(points[k - 1], points[k]));
      }

      double length() const { return at_point.back(); }

      Point2 at(const double s) const
      {
        const std::size_t k = segment(s);
        return between(points[k], points[k + 1], (s - at_point[k]) / (at_point[k + 1] - at_point[k]));
      }

      /** Returns the coordinate of the nearest point, and its distance. Of several points at equal distances, such as on
       * both sides of a symmetric valley, it returns the mean of the first and the last coordinate. */
      std::pair<double, double> nearest(const Point2 &p) const
      {
        double first = 0., last = 0., least = 1e300;
        for (std::size_t k = 0; k + 1 < points.size(); ++k)
        {
          const double length = at_point[k + 1] - at_point[k];
          if (length == 0.)
            continue;
          const double t = std::clamp(((p[0] - points[k][0]) * (points[k + 1][0] - points[k][0]) +
                                       (p[1] - points[k][1]) * (points[k + 1][1] - points[k][1])) /
                                          (length * length),
                                      0., 1.),
                       far = Voussoir::distance(p, between(points[k], points[k + 1], t)),
                       equal = 1e-7 * at_point.back();
          if (far < least + equal)
            last = at_point[k] + t * length;
          if (far < least - equal)
            first = last;
          least = std::min(least, far);
        }
        return {.5 * (first + last), least};
      }

      /** Returns true if the point is between the bank and the water line. */
      bool encloses(const Point2 &p) const
      {
        bool inside = false;
        for (std::size_t k = 0; k < points.size(); ++k)
        {
          const Point2 &a = points[k], &b = points[(k + 1) % points.size()];
          if ((a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
            inside = !inside;
        }
        return inside;
      }

      /** Returns n + 1 coordinates from end to end: the corners of the bank, where its direction changes by more than 25
       * degrees, and points at equal distances between them. @p is_corner: receives which ones are corners. */
      std::vector<double> spread(const std::size_t n, std::vector<bool> &is_corner) const
      {
        std::vector<double> result(n + 1, 0.);
        is_corner.assign(n + 1, false);
        result[n] = length();
        std::size_t last = 0; // corner or end
        const auto  fill = [&](const std::size_t next)
        {
          for (std::size_t k = last + 1; k < next; ++k)
            result[k] = result[last] + (result[next] - result[last]) * (k - last) / double(next - last);
          last = next;
        };
        for (std::size_t p = 1; p + 1 < points.size(); ++p)
        {
          const Point2 &a = points[p - 1], &b = points[p], &c = points[p + 1];
          const double  along = (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]);
          if (std::abs(std::atan2(cross(a, b, c), along)) < 25. * M_PI / 180.)
            continue;
          const std::size_t k = std::lround(at_point[p] / length() * n);
          if (k <= last || k >= n)
            continue;
          result[k] = at_point[p];
          is_corner[k] = true;
          fill(k);
        }
        fill(n);
        return result;
      }

      std::vector<Point2> points;

    private:
      std::size_t segment(const double s) const
      {
        const auto k = std::upper_bound(at_point.begin(), at_point.end(), s) - at_point.begin();
        return std::clamp<std::ptrdiff_t>(k - 1, 0, points.size() - 2);
      }

      std::vector<double> at_point;
    };

    [[noreturn]] void too_coarse(const std::string &why, const double h)
    {
      throw CoarseWater("Mesh of the water: " + why + " with water elements of " + number_text(h) + " m.");
    }

    /** Squares below the water line by column and row, from the lower right corner. */
    using Squares = std::set<std::pair<int, int>>;

    Squares squares_in(const Bank &bank, const double level, const double middle, const double h)
    {
      double low = level, right = middle, left = middle;
      for (const Point2 &p : bank.points)
        low = std::min(low, p[1]), right = std::min(right, p[0]), left = std::max(left, p[0]);
      const int n = std::ceil(std::max(left - middle, middle - right) / h),
                rows = std::ceil((level - low) / h);
      const auto is_free = [&](const int i, const int j) // corner, j rows below the water line
      {
        const Point2 p = {middle + i * h, level - j * h}, below = {p[0], p[1] - (j == 0 ? 1e-6 * h : 0.)};
        return bank.encloses(below) && bank.nearest(p).second > .35 * h;
      };
      Squares kept;
      for (int i = -n; i < n; ++i)
        for (int j = 0; j < rows; ++j)
          if (is_free(i, j) && is_free(i + 1, j) && is_free(i, j + 1) && is_free(i + 1, j + 1))
            kept.insert({i, j});
      for (bool changed = true; changed;)
      {
        changed = false;
        for (auto square = kept.begin(); square != kept.end();)
        {
          const auto [i, j] = *square;
          const std::size_t neighbours = kept.count({i - 1, j}) + kept.count({i + 1, j}) +
                                         kept.count({i, j + 1}) + (j == 0 ? 1 : kept.count({i, j - 1}));
          if (neighbours < 2)
          {
            square = kept.erase(square);
            changed = true;
          }
          else
            ++square;
        }
      }
      return kept;
    }

    /** Returns the nodes of the staircase below the squares, from the right end of the water line to the left. */
    std::vector<unsigned int> staircase(const std::vector<std::array<unsigned int, 4>> &cells,
                                        const std::vector<bool> &at_surface, const double h)
    {
      std::map<Edge, int> edges;
      for (const auto &cell : cells)
        for (unsigned int k = 0; k < 4; ++k)
        {
          const Edge edge(cell[k], cell[(k + 1) % 4]);
          if (edges.erase({edge.second, edge.first}) == 0)
            edges[edge] = 1;
        }
      std::map<unsigned int, unsigned int> next;
      std::set<unsigned int>               ends;
      for (const auto &edge : edges)
        if (!(at_surface[edge.first.first] && at_surface[edge.first.second]))
        {
          if (!next.emplace(edge.first.first, edge.first.second).second)
            too_coarse("the section of the reservoir has a neck", h);
          ends.insert(edge.first.second);
        }
      std::vector<unsigned int> chain;
      for (const auto &edge : next)
        if (ends.count(edge.first) == 0)
          chain.push_back(edge.first);
      if (chain.size() != 1)
        too_coarse("the section of the reservoir is not one piece", h);
      while (next.count(chain.back()) > 0)
        chain.push_back(next.at(chain.back()));
      if (chain.size() != next.size() + 1 || !at_surface[chain.front()] || !at_surface[chain.back()])
        too_coarse("the section of the reservoir is not one piece", h);
      return chain;
    }
  } // namespace

  namespace
  {
    /** Smooths the nodes near the bank. */
    void smooth(WaterSection &section, const Bank &bank, const std::vector<unsigned int> &stairs,
                const std::vector<bool> &is_corner)
    {
      constexpr unsigned int              sweeps = 120, rings = 2;
      std::vector<std::set<unsigned int>> neighbours(section.points.size());
      for (const auto &cell : section.cells)
        for (unsigned int k = 0; k < 4; ++k)
        {
          neighbours[cell[k]].insert(cell[(k + 1) % 4]);
          neighbours[cell[k]].insert(cell[(k + 3) % 4]);
        }
      std::set<unsigned int> moving(stairs.begin(), stairs.end());
      for (unsigned int ring = 0; ring < rings; ++ring)
        for (const unsigned int node : std::set<unsigned int>(moving))
          moving.insert(neighbours[node].begin(), neighbours[node].end());
      std::vector<double> place; // of the bank nodes
      for (const unsigned int node : section.bank)
      {
        place.push_back(bank.nearest(section.points[node]).first);
        moving.erase(node);
      }
      std::vector<Point2> before; // of this iteration: the mesh of a symmetric section is symmetric
      const auto          relaxed = [&](const unsigned int node)
      {
        Point2 sum{};
        for (const unsigned int other : neighbours[node])
          sum[0] += before[other][0], sum[1] += before[other][1];
        return between(before[node], {sum[0] / neighbours[node].size(), sum[1] / neighbours[node].size()},
                       .5);
      };
      for (unsigned int sweep = 0; sweep < sweeps; ++sweep)
      {
        before = section.points;
        const std::vector<double> last = place;
        for (const unsigned int node : moving)
        {
          const Point2 target = relaxed(node);
          section.points[node] = {target[0], section.at_surface[node] ? before[node][1] : target[1]};
        }
        for (std::size_t k = 1; k + 1 < section.bank.size(); ++k)
        {
          if (is_corner[k])
            continue;
          const double room = .2 * (last[k + 1] - last[k - 1]);
          place[k] = std::clamp(bank.nearest(relaxed(section.bank[k])).first, last[k - 1] + room,
                                last[k + 1] - room);
          section.points[section.bank[k]] = bank.at(place[k]);
        }
      }
    }

    /** Finds x and the monolith of the wet face at a point, by the bilinear map of the face that holds it, or else of
     * the nearest face. */
    std::pair<double, int> on_face(const std::vector<WetQuad> &faces, const Point2 &p)
    {
      std::pair<double, int> best;
      double                 least = 1e300;
      for (const WetQuad &face : faces)
      {
        const auto &c = face.corners;
        double      reach = 0.;
        for (unsigned int k = 0; k < 4; ++k)
          reach = std::max(reach, distance(projected(c[k]), projected(c[(k + 2) % 4])));
        if (distance(p, projected(c[0])) > 3. * reach)
          continue;
        double s = .5, t = .5;
        Point2 r;
        for (unsigned int pass = 0; pass < 20; ++pass)
        {
          Point2 a, b;
          for (unsigned int d = 0; d < 2; ++d)
          {
            const double c0 = c[0][d + 1], c1 = c[1][d + 1], c2 = c[2][d + 1], c3 = c[3][d + 1];
            r[d] = (1 - s) * (1 - t) * c0 + s * (1 - t) * c1 + s * t * c2 + (1 - s) * t * c3 - p[d];
            a[d] = (1 - t) * (c1 - c0) + t * (c2 - c3);
            b[d] = (1 - s) * (c3 - c0) + s * (c2 - c1);
          }
          const double det = a[0] * b[1] - a[1] * b[0];
          s = std::clamp(s - (r[0] * b[1] - r[1] * b[0]) / det, -2., 3.);
          t = std::clamp(t - (a[0] * r[1] - a[1] * r[0]) / det, -2., 3.);
        }
        const bool is_found =
            std::hypot(r[0], r[1]) < 1e-6 * reach; // far from some faces the iteration fails
        const double outside = is_found ? std::max({-s, s - 1., -t, t - 1., 0.}) : 10.;
        if (outside < least)
        {
          least = outside;
          s = std::clamp(s, 0., 1.), t = std::clamp(t, 0., 1.);
          best = {(1 - s) * (1 - t) * c[0][0] + s * (1 - t) * c[1][0] + s * t * c[2][0] +
                      (1 - s) * t * c[3][0],
                  face.monolith};
        }
        if (least == 0.)
          break;
      }
      return best;
    }
  } // namespace

  namespace
  {
    /** Fills the section with squares, and joins them to the bank. */
    void fill_banks(WaterSection &section, const Bank &curve, const std::vector<WetQuad> &faces,
                    const double level, const double h)
    {
      std::vector<Point2> &points = section.points;
      std::vector<bool>   &at_surface = section.at_surface;
      auto                &cells = section.cells;
      auto                &bank = section.bank;
      const double         centre = .5 * (curve.points.front()[0] + curve.points.back()[0]), aside = 1e-4 * h;
      double               middle = centre;
      const auto side = [&](const double by) { return on_face(faces, {centre + by, level - .5 * h}).second; };
      const bool at_joint = side(-aside) != side(aside); // a node there would belong to one side only
      Squares    squares = squares_in(curve, level, middle, h);
      if (const Squares other = squares_in(curve, level, middle + .5 * h, h);
          other.size() > (at_joint ? 0 : squares.size()))
      {
        squares = other;
        middle += .5 * h;
      }
      if (squares.empty())
        too_coarse("the section of the reservoir holds no square", h);
      std::map<std::pair<int, int>, unsigned int> number;
      const auto                                  node = [&](const int i, const int j)
      {
        const auto found = number.emplace(std::pair(i, j), points.size());
        if (found.second)
        {
          points.push_back({middle + i * h, level - j * h});
          at_surface.push_back(j == 0);
        }
        return found.first->second;
      };
      for (const auto &[i, j] : squares)
        cells.push_back({node(i, j + 1), node(i + 1, j + 1), node(i + 1, j), node(i, j)});
      const std::vector<unsigned int> stairs = staircase(cells, at_surface, h);
      std::vector<bool>               is_corner;
      const std::vector<double>       place = curve.spread(stairs.size() - 1, is_corner);
      for (std::size_t k = 0; k < stairs.size(); ++k)
      {
        bank.push_back(points.size());
        points.push_back(curve.at(place[k]));
        at_surface.push_back(k == 0 || k + 1 == stairs.size());
      }
      for (std::size_t k = 0; k + 1 < stairs.size(); ++k)
        cells.push_back({bank[k], bank[k + 1], stairs[k + 1], stairs[k]});
      smooth(section, curve, stairs, is_corner);
      for (const auto &cell : cells)
        for (unsigned int k = 0; k < 4; ++k)
          if (!(cross(points[cell[k]], points[cell[(k + 1) % 4]], points[cell[(k + 3) % 4]]) > .02 * h * h))
            too_coarse("the section of the reservoir has a distorted element near y = " +
                           number_text(points[cell[k]][0]) + " m, z = " + number_text(points[cell[k]][1]) +
                           " m",
                       h);
    }

    /** Fills the section of a slice: one column of quadrilaterals between the planes y = constant. */
    void fill_slice(WaterSection &section, const Bank &bank, const double level, const double h)
    {
      const double right = bank.points.front()[0], left = bank.points.back()[0];
      double       low = level;
      for (const Point2 &p : bank.points)
        low = std::min(low, p[1]);
      const auto n = std::max<unsigned int>(2, std::lround((level - low) / h));
      for (unsigned int k = 0; k <= n; ++k)
      {
        for (const double y : {right, left})
        {
          section.points.push_back({y, level - (n - k) * (level - low) / n});
          section.at_surface.push_back(k == n);
        }
        if (k < n)
          section.cells.push_back({2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2});
      }
      section.bank = {0, 1};
    }
  } // namespace

  WaterSection::WaterSection(const std::vector<WetQuad> &faces, const double level, const double h,
                             const bool is_slice)
  {
    check_folds(faces);
    const Bank   curve(bank_of(outline(faces), level));
    const double centre = .5 * (curve.points.front()[0] + curve.points.back()[0]), aside = 1e-4 * h;
    if (is_slice)
      fill_slice(*this, curve, level, h);
    else
      fill_banks(*this, curve, faces, level, h);
    for (const Point2 &point : points)
    {
      face_x.push_back(on_face(faces, point).first);
      monolith.push_back(on_face(faces, {point[0] + (point[0] < centre ? aside : -aside), point[1]}).second);
    }
  }
} // namespace Voussoir
