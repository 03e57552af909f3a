// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/output/face_tension.h>
#include <voussoir/solid/face_quads.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Voussoir
{
  using namespace dealii;

  namespace
  {
    /** The share of each node in the area of a surface [m^2]. */
    std::map<unsigned int, double> areas(const SolidModel &model, const int surface)
    {
      std::map<unsigned int, double> result;
      for (const FaceQuad &quad : face_quads(model, surface))
        for (const unsigned int node : quad.nodes)
          result[node] += area(model, quad) / 4.;
      return result;
    }
  } // namespace

  FaceTension::FaceTension(const SolidModel &model)
  {
    std::vector<Point<3>> base;
    double                top = -1e300, bottom = 1e300;
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
    {
      top = std::max(top, model.points[i][2]);
      bottom = std::min(bottom, model.points[i][2]);
      if (model.on_surface(i, PhysicalId::base) &&
          (model.on_surface(i, PhysicalId::upstream) || model.on_surface(i, PhysicalId::downstream)))
        base.push_back(model.points[i]);
    }
    const double reach = .1 * (top - bottom);
    for (const int surface : {PhysicalId::upstream, PhysicalId::downstream})
      for (const auto &node : areas(model, surface))
      {
        const Point<3> &x = model.points[node.first];
        const bool      is_foot =
            std::any_of(base.begin(), base.end(), [&](const Point<3> &p) { return p.distance(x) < reach; });
        faces[surface].push_back({node.first, node.second, is_foot});
      }
  }

  Extreme FaceTension::largest_above_foot(const EnvelopeRecorder &envelope, const SolidModel &model,
                                          const int surface) const
  {
    Extreme largest{std::numeric_limits<double>::quiet_NaN()};
    if (const auto face = faces.find(surface); face != faces.end())
      for (const FaceNode &n : face->second)
        if (const double x = envelope.maximum[n.node]; !n.is_foot && !(x <= largest.value))
        {
          const Point<3> &p = model.points[n.node];
          largest = {x, envelope.time_of_maximum[n.node], {{p[0], p[1], p[2]}}};
        }
    return largest;
  }

  double FaceTension::difference(const EnvelopeRecorder &a, const EnvelopeRecorder &b,
                                 const int surface) const
  {
    const auto face = faces.find(surface);
    double     largest = 0., sum = 0., area = 0.;
    if (face == faces.end())
      return std::numeric_limits<double>::quiet_NaN();
    for (const FaceNode &n : face->second)
      largest = n.is_foot ? largest : std::max<double>(largest, a.maximum[n.node]);
    for (const FaceNode &n : face->second)
      if (!n.is_foot && a.maximum[n.node] >= .5 * largest)
      {
        const double apart = double(a.maximum[n.node]) - b.maximum[n.node];
        sum += n.area * apart * apart;
        area += n.area;
      }
    return area > 0. ? std::sqrt(sum / area) : 0.;
  }

  double FaceTension::headline(const EnvelopeRecorder &envelope) const
  {
    double largest = 0.;
    for (const auto &face : faces)
      for (const FaceNode &n : face.second)
        if (!n.is_foot)
          largest = std::max<double>(largest, envelope.maximum[n.node]);
    return largest;
  }

  FaceTension::Part FaceTension::above(const EnvelopeRecorder &envelope, const int surface,
                                       const double strength) const
  {
    Part part;
    if (const auto face = faces.find(surface); face != faces.end())
      for (const FaceNode &n : face->second)
      {
        part.whole += n.area;
        part.area += envelope.maximum[n.node] > strength ? n.area : 0.;
      }
    return part;
  }
} // namespace Voussoir
