// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/water/pressure_point.h>

#include <algorithm>

namespace Voussoir
{
  namespace
  {
    /** Point on an edge: between its nodes. */
    struct Crossing
    {
      unsigned int a, b;
      double       t; ///< 0 at a, 1 at b [-]
      double       y; ///< [m]
    };

    /** Part of the horizontal line in one face of the water, from small to large y. */
    using Chord = std::array<Crossing, 2>;

    std::vector<Chord> chords_at(const WaterMesh &mesh, const double z)
    {
      std::vector<Chord> chords;
      for (const WaterMesh::Face &face : mesh.wet)
      {
        std::vector<Crossing> found;
        for (unsigned int k = 0; k < 4; ++k)
        {
          const unsigned int a = face[k], b = face[(k + 1) % 4];
          const Vector3     &p = mesh.points[a], &q = mesh.points[b];
          if ((p[2] < z) == (q[2] < z))
            continue;
          const double t = (z - p[2]) / (q[2] - p[2]);
          found.push_back({a, b, t, p[1] + t * (q[1] - p[1])});
        }
        if (found.size() < 2)
          continue;
        const auto [low, high] = std::minmax_element(found.begin(), found.end(),
                                                     [](const auto &a, const auto &b) { return a.y < b.y; });
        chords.push_back({*low, *high});
      }
      return chords;
    }
  } // namespace

  double PressurePoint::value(const std::vector<double> &values) const
  {
    double sum = 0.;
    for (const auto &[node, weight] : weights)
      sum += weight * values[node];
    return sum;
  }

  PressurePoint pressure_point(const WaterMesh &mesh, double z)
  {
    double low = 1e300, high = -1e300;
    for (const WaterMesh::Face &face : mesh.wet)
      for (const unsigned int node : face)
      {
        low = std::min(low, mesh.points[node][2]);
        high = std::max(high, mesh.points[node][2]);
      }
    z = std::clamp(z, low + 1e-9 * (high - low), high - 1e-9 * (high - low));
    const std::vector<Chord> chords = chords_at(mesh, z);
    double                   right = 1e300, left = -1e300;
    for (const Chord &chord : chords)
      right = std::min(right, chord[0].y), left = std::max(left, chord[1].y);
    const double middle = .5 * (right + left);
    const auto   distance = [&](const Chord &chord) {
      return std::max({chord[0].y - middle, middle - chord[1].y, 0.});
    };
    double least = 1e300;
    for (const Chord &chord : chords)
      least = std::min(least, distance(chord));
    PressurePoint      point;
    std::vector<Chord> nearest; // two at a common edge
    std::copy_if(chords.begin(), chords.end(), std::back_inserter(nearest),
                 [&](const Chord &chord) { return distance(chord) <= least + 1e-6 * (left - right); });
    for (const Chord &chord : nearest)
    {
      const double length = chord[1].y - chord[0].y,
                   s = length > 0. ? std::clamp((middle - chord[0].y) / length, 0., 1.) : .5;
      for (unsigned int k = 0; k < 2; ++k)
      {
        const Crossing &at = chord[k];
        const double    share = (k == 0 ? 1. - s : s) / nearest.size();
        point.weights.emplace_back(at.a, share * (1. - at.t));
        point.weights.emplace_back(at.b, share * at.t);
      }
    }
    for (const auto &[node, weight] : point.weights)
      for (unsigned int d = 0; d < 3; ++d)
        point.place[d] += weight * mesh.points[node][d];
    return point;
  }
} // namespace Voussoir
