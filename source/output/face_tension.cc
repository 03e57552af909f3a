// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/mesh/coincident.h>
#include <voussoir/output/face_tension.h>
#include <voussoir/solid/face_quads.h>

#include <algorithm>
#include <limits>

namespace Voussoir
{
  namespace
  {
    /** Returns the area of each node of a surface [m^2]. */
    std::map<unsigned int, double> areas(const SolidModel &model, const int surface)
    {
      std::map<unsigned int, double> result;
      for (const FaceQuad &quad : face_quads(model, surface))
        for (const unsigned int node : quad.nodes)
          result[node] += area(model, quad) / 4.;
      return result;
    }
  } // namespace

  FaceTension::FaceTension(const SolidModel &model) : near_base(model.n_nodes(), false)
  {
    std::vector<std::array<double, 3>> base;
    const auto place = [&](const unsigned int i) -> std::array<double, 3> { return model.points[i]; };
    double     top = -1e300, bottom = 1e300;
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
    {
      top = std::max(top, model.points[i][2]);
      bottom = std::min(bottom, model.points[i][2]);
      if (model.on_surface(i, PhysicalId::base))
        base.push_back(place(i));
    }
    const double      reach = .1 * (top - bottom);
    const PointFinder finder(base);
    for (unsigned int i = 0; i < model.n_nodes() && !base.empty(); ++i)
      near_base[i] = finder.nearest(place(i)).distance < reach;
    for (const int surface : {PhysicalId::upstream, PhysicalId::downstream})
      for (const auto &node : areas(model, surface))
        faces[surface].push_back({node.first, node.second});
  }

  namespace
  {
    Extreme extreme_at(const SolidModel &model, const unsigned int node, const double value,
                       const double time)
    {
      const Vector3 &p = model.points[node];
      return {value, time, {{p[0], p[1], p[2]}}};
    }
  } // namespace

  Extreme FaceTension::largest_away_from_base(const EnvelopeRecorder &envelope, const SolidModel &model,
                                              const int surface) const
  {
    Extreme largest{std::numeric_limits<double>::quiet_NaN()};
    if (const auto face = faces.find(surface); face != faces.end())
      for (const FaceNode &n : face->second)
        if (const double x = envelope.maximum[n.node]; !near_base[n.node] && !(x <= largest.value))
          largest = extreme_at(model, n.node, x, envelope.time_of_maximum[n.node]);
    return largest;
  }

  Extreme FaceTension::smallest_away_from_base(const EnvelopeRecorder &envelope,
                                               const SolidModel       &model) const
  {
    Extreme smallest{std::numeric_limits<double>::quiet_NaN()};
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
      if (const double x = envelope.minimum[i]; !near_base[i] && !(x >= smallest.value))
        smallest = extreme_at(model, i, x, envelope.time_of_minimum[i]);
    return smallest;
  }

  Extreme FaceTension::extreme_away_from_base(const FaceEnvelope &envelope, const SolidModel &model,
                                              const int surface, const unsigned int k,
                                              const bool largest) const
  {
    Extreme result{std::numeric_limits<double>::quiet_NaN()};
    for (std::size_t i = 0; i < envelope.directions.nodes.size(); ++i)
      if (const NodeOnFace &at = envelope.directions.nodes[i]; at.surface == surface && !near_base[at.node])
        if (const auto [x, time] = envelope.extreme(i, k, largest);
            !(largest ? x <= result.value : x >= result.value))
          result = extreme_at(model, at.node, x, time);
    return result;
  }

  double FaceTension::headline(const EnvelopeRecorder &envelope) const
  {
    double largest = 0.;
    for (const auto &face : faces)
      for (const FaceNode &n : face.second)
        if (!near_base[n.node])
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
