// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/output_file.h>
#include <voussoir/joints/pairs.h>
#include <voussoir/output/joint_points.h>
#include <voussoir/solid/face_quads.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace Voussoir
{
  namespace
  {
    constexpr double endless = std::numeric_limits<double>::infinity();

    double length_of_slip(const Vector3 &moved)
    {
      return length(moved[1], moved[2]);
    }
  } // namespace

  JointPoints::JointPoints(const SolidModel &model, const std::vector<Pair> &pairs,
                           const unsigned int n_joints, const double depth)
      : pairs(pairs), rims(n_joints), now(pairs.size(), Vector3{}), opening(pairs.size(), 0.),
        slip(pairs.size(), 0.)
  {
    const PairsByNode pair_of = pairs_by_node(pairs);
    for (unsigned int j = 0; j < n_joints; ++j)
      for (const FaceQuad &quad : quads_of_joint(model, j))
      {
        Quad of_joint{{}, j};
        bool complete = true;
        for (unsigned int k = 0; k < 4; ++k)
        {
          const unsigned int from = quad.nodes[k], to = quad.nodes[(k + 1) % 4];
          if (model.on_surface(from, PhysicalId::upstream) && model.on_surface(to, PhysicalId::upstream))
            rims[j].push_back({{model.points[from], model.points[to]}});
          const auto found = pair_of.find({j, model.equation[from]});
          complete = complete && found != pair_of.end();
          of_joint.pairs[k] = complete ? found->second : 0;
        }
        if (complete)
          quads.push_back(of_joint);
      }
    for (const Pair &pair : pairs)
      this->depth.push_back(distance(pair.place, pair.joint));
    find_waterstops(depth);
  }

  /** Returns the distance of a point from the edge of a joint on the upstream face [m], or infinity. */
  double JointPoints::distance(const Vector3 &p, const unsigned int joint) const
  {
    double nearest = endless;
    for (const auto &[a, b] : rims[joint])
    {
      const Vector3 along = b - a, to = p - a;
      const double  square = along[0] * along[0] + along[1] * along[1] + along[2] * along[2];
      const double  t = std::clamp((to[0] * along[0] + to[1] * along[1] + to[2] * along[2]) / square, 0., 1.);
      nearest =
          std::min(nearest, std::hypot(to[0] - t * along[0], to[1] - t * along[1], to[2] - t * along[2]));
    }
    return nearest;
  }

  /** Finds the points of the quadrilateral edges at the given depth. Edges along the face have none. */
  void JointPoints::find_waterstops(const double at)
  {
    std::set<std::pair<unsigned int, unsigned int>> known;
    for (const Quad &quad : quads)
      for (unsigned int k = 0; k < 4; ++k)
      {
        unsigned int from = quad.pairs[k], to = quad.pairs[(k + 1) % 4];
        if (depth[from] > depth[to])
          std::swap(from, to);
        if (!(depth[from] <= at && at < depth[to]) || !known.emplace(from, to).second)
          continue;
        waterstops.push_back({from, to, (at - depth[from]) / (depth[to] - depth[from])});
      }
  }

  std::pair<double, unsigned int> JointPoints::height_without_waterstop() const
  {
    std::vector<double> top(rims.size(), -endless), bottom(rims.size(), endless),
        highest(rims.size(), -endless);
    for (unsigned int p = 0; p < pairs.size(); ++p)
    {
      const unsigned int j = pairs[p].joint;
      top[j] = std::max(top[j], pairs[p].place[2]);
      bottom[j] = std::min(bottom[j], pairs[p].place[2]);
    }
    for (const Between &point : waterstops)
    {
      const double from = pairs[point.from].place[2], to = pairs[point.to].place[2];
      double      &z = highest[pairs[point.from].joint];
      z = std::max(z, from + point.share * (to - from));
    }
    std::pair<double, unsigned int> worst(0., 0);
    for (unsigned int j = 0; j < rims.size(); ++j)
    {
      constexpr double of_crest = .02; // tolerance, because the crest may be inclined
      const double     missing = top[j] - std::max(highest[j], bottom[j]);
      if (top[j] > bottom[j] && missing > of_crest * (top[j] - bottom[j]) && missing > worst.first)
        worst = {missing, j + 1};
    }
    return worst;
  }

  void JointPoints::record(const unsigned int pair, const Vector3 &moved)
  {
    if (pair >= now.size())
      return;
    now[pair] = moved;
    opening[pair] = std::max(opening[pair], moved[0]);
    slip[pair] = std::max(slip[pair], length_of_slip(moved));
  }

  void JointPoints::end_record(const double time)
  {
    last_time = time;
    for (const Between &point : waterstops)
    {
      const Vector3 &a = now[point.from], &b = now[point.to];
      const Vector3 &from = pairs[point.from].place, &to = pairs[point.to].place;
      Vector3        moved, place;
      for (unsigned int d = 0; d < 3; ++d)
      {
        moved[d] = a[d] + point.share * (b[d] - a[d]);
        place[d] = from[d] + point.share * (to[d] - from[d]);
      }
      waterstop_opening.raise(moved[0], time, place);
      waterstop_slip.raise(length_of_slip(moved), time, place);
    }
  }

  Extreme JointPoints::residual(const bool of_slip) const
  {
    Extreme largest;
    for (std::size_t p = 0; p < now.size(); ++p)
      largest.raise(of_slip ? length_of_slip(now[p]) : now[p][0], last_time, pairs[p].place);
    return largest;
  }

  std::vector<JointPoints::Residual> JointPoints::residuals() const
  {
    std::vector<Residual> largest(rims.size());
    for (std::size_t p = 0; p < now.size(); ++p)
    {
      Residual &of_joint = largest[pairs[p].joint];
      of_joint.opening = std::max(of_joint.opening, now[p][0]);
      of_joint.slip = std::max(of_joint.slip, length_of_slip(now[p]));
    }
    return largest;
  }

  void JointPoints::end_part()
  {
    for (const Residual &of_joint : residuals())
      of_parts.insert(of_parts.end(), {of_joint.opening, of_joint.slip});
  }

  std::vector<JointPoints::Residual> JointPoints::residuals_of_part(const std::size_t part) const
  {
    std::vector<Residual> result;
    const std::size_t     n = rims.size();
    for (std::size_t j = n * part; j < n * (part + 1) && 2 * j < of_parts.size(); ++j)
      result.push_back({of_parts[2 * j], of_parts[2 * j + 1]});
    return result;
  }

  void JointPoints::write(const std::string &directory, const DamGeometry &geometry,
                          const std::vector<Vector3> &at_start) const
  {
    OutputFile points(directory + "/joint_points.csv"), cells(directory + "/joint_cells.csv");
    points.precision(8);
    points << "joint,x,y,z,s,depth,area,max_opening,max_slip,residual_opening,residual_slip,static_pressure,"
              "static_opening,static_distance\n";
    for (std::size_t p = 0; p < pairs.size(); ++p)
    {
      const Vector3 &x = pairs[p].place;
      points << pairs[p].joint + 1 << ',' << x[0] << ',' << x[1] << ',' << x[2] << ','
             << geometry.arc_length(x) << ',' << depth[p] << ',' << pairs[p].area << ',' << opening[p] << ','
             << slip[p] << ',' << std::max(now[p][0], 0.) << ',' << length_of_slip(now[p]) << ','
             << at_start[p][0] << ',' << at_start[p][1] << ',' << at_start[p][2] << '\n';
    }
    cells << "joint,n0,n1,n2,n3\n";
    for (const Quad &quad : quads)
      cells << quad.joint + 1 << ',' << quad.pairs[0] << ',' << quad.pairs[1] << ',' << quad.pairs[2] << ','
            << quad.pairs[3] << '\n';
    points.check();
    cells.check();
  }
} // namespace Voussoir
