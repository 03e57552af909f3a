// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/mesh/coincident.h>
#include <voussoir/water/water_mesh.h>
#include <voussoir/water/water_size.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Voussoir
{
  namespace
  {
    constexpr double damped_depths = 5.; ///< length of the damped layers, in depths
    constexpr double growth = 1.05;      ///< of the damped layers

    /** Returns the distances of the layers from the dam, relative to the whole @p length [m]. @p undamped: receives the
     * number of layers without damping, @p last the length of the last one [m]. */
    std::vector<double> layers_of(const WaterProperties &properties, unsigned int &undamped, double &length,
                                  double &last)
    {
      undamped = std::max<unsigned int>(2, std::lround(properties.length / (1.5 * properties.h)));
      std::vector<double> lengths;
      for (unsigned int k = 0; k < undamped; ++k)
        lengths.push_back(properties.length / undamped * (2. / 3. + 2. / 3. * k / (undamped - 1.)));
      for (double damped = 0.; damped < damped_depths * properties.depth; damped += lengths.back())
        lengths.push_back(lengths.back() * growth);
      std::vector<double> layers = {0.};
      for (const double x : lengths)
        layers.push_back(layers.back() + x);
      length = layers.back();
      last = lengths.back();
      for (double &place : layers)
        place /= length;
      return layers;
    }
  } // namespace

  double channel_nodes(const double area, const double depth, const double length, const double h)
  {
    const double size = h > 0. ? h : depth / 16., undamped = length > 0. ? length : 2. * depth,
                 layers = undamped / (1.5 * size) +
                          std::log1p((growth - 1.) * damped_depths * depth / (1.4 * size)) / std::log(growth);
    return (layers + 2.) * (area / (size * size) + 3. * std::sqrt(area) / size);
  }

  std::vector<unsigned int> WaterMesh::end_nodes() const
  {
    std::vector<unsigned int> nodes;
    for (const Face &face : end)
      nodes.insert(nodes.end(), face.begin(), face.end());
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }

  Vector3 WaterMesh::end_normal() const
  {
    Vector3 normal{};
    for (const Face &face : end)
      for_points(corners(points, face), [&](const Vector3 &area, const auto &) { add(normal, area); });
    const double size = norm(normal);
    return {{normal[0] / size, normal[1] / size, normal[2] / size}};
  }

  void WaterMesh::link()
  {
    double size = 0.;
    for (const Vector3 &x : points)
      size = std::max({size, std::abs(x[1]), std::abs(x[2])});
    std::map<std::pair<long, long>, unsigned int> number;
    const Vector3                                 n = end_normal();
    const auto                                    flat = [&](const Vector3 &x)
    {
      const double along = dot(x, n);
      return Vector3{{x[0] - along * n[0], x[1] - along * n[1], x[2] - along * n[2]}};
    };
    std::vector<Vector3> of_end;
    for (const unsigned int node : end_nodes())
      of_end.push_back(flat(points[node]));
    const PointFinder finder(of_end);
    for (const Vector3 &x : points)
    {
      const auto found = number.emplace(
          std::pair(std::lround(1e7 * x[1] / size), std::lround(1e7 * x[2] / size)), places.size());
      if (found.second)
        places.push_back(x);
      column.push_back(found.first->second);
      far.push_back(finder.nearest(flat(x)).number);
    }
  }

  WaterMesh WaterMesh::far_channel() const
  {
    const std::vector<unsigned int> nodes = end_nodes();
    const unsigned int              n = nodes.size();
    const Vector3                   normal = end_normal();
    WaterMesh                       result;
    result.places = places;
    result.is_slice = is_slice;
    for (const double along : {0., last_length})
      for (const unsigned int node : nodes)
      {
        Vector3 x = points[node];
        for (unsigned int d = 0; d < 3; ++d)
          x[d] += along * normal[d];
        result.points.push_back(x);
        result.at_surface.push_back(at_surface[node]);
        result.column.push_back(column[node]);
      }
    result.layer.assign(2 * n, 0.);
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> edges; // with direction
    for (Face face : end)
    {
      for (unsigned int &node : face)
        node = std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin();
      result.cells.push_back(
          {face[0], face[1], face[2], face[3], n + face[0], n + face[1], n + face[2], n + face[3]});
      for (unsigned int k = 0; k < 4; ++k)
        if (const unsigned int a = face[k], b = face[(k + 1) % 4]; edges.erase({b, a}) == 0)
          edges[{a, b}] = 1;
    }
    for (const auto &[edge, unused] : edges)
      if (const auto [a, b] = edge; (!result.at_surface[a] || !result.at_surface[b]) &&
                                    !(is_slice && result.points[a][1] == result.points[b][1]))
        result.bed.push_back({a, b, n + b, n + a});
    return result;
  }

  WaterMesh make_channel(const WaterSection &section, const WaterProperties &properties)
  {
    const unsigned int        n = section.points.size();
    unsigned int              undamped;
    double                    length;
    WaterMesh                 mesh;
    const std::vector<double> layers = layers_of(properties, undamped, length, mesh.last_length);
    mesh.is_slice = properties.is_slice;
    mesh.monolith = section.monolith;
    const double end = *std::min_element(section.face_x.begin(), section.face_x.end()) - length;
    const auto   node = [&](const std::size_t k, const unsigned int j)
    { return static_cast<unsigned int>(k * n + j); };
    for (std::size_t k = 0; k < layers.size(); ++k)
    {
      const double t = layers[k], from = layers[undamped];
      for (unsigned int j = 0; j < n; ++j)
      {
        mesh.points.push_back({{section.face_x[j] + t * (end - section.face_x[j]), section.points[j][0],
                                section.points[j][1]}});
        mesh.at_surface.push_back(section.at_surface[j]);
        mesh.layer.push_back(k > undamped ? (t - from) / (1. - from) : 0.);
      }
      if (k == 0)
        continue;
      for (const auto &[a, b, c, d] : section.cells)
        mesh.cells.push_back({node(k - 1, a), node(k - 1, b), node(k - 1, c), node(k - 1, d), node(k, a),
                              node(k, b), node(k, c), node(k, d)});
      for (std::size_t b = 0; b + 1 < section.bank.size(); ++b) // from small to large y below the water
        mesh.bed.push_back({node(k - 1, section.bank[b]), node(k, section.bank[b]),
                            node(k, section.bank[b + 1]), node(k - 1, section.bank[b + 1])});
    }
    for (const auto &cell : section.cells)
      mesh.wet.push_back(cell);
    for (const auto &[a, b, c, d] : section.cells)
      mesh.end.push_back({node(layers.size() - 1, d), node(layers.size() - 1, c), node(layers.size() - 1, b),
                          node(layers.size() - 1, a)});
    mesh.link();
    return mesh;
  }
} // namespace Voussoir
