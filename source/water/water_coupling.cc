// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/number_text.h>
#include <voussoir/mesh/coincident.h>
#include <voussoir/solid/face_quads.h>
#include <voussoir/water/water_coupling.h>
#include <voussoir/water/water_size.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Voussoir
{
  namespace
  {
    Vector3 place_of(const SolidModel &dam, const unsigned int node)
    {
      return dam.points[node];
    }

    /** Returns the number of parts in both directions of a face. In a slice it is independent of the thickness, and
     * even: the two sides have equal areas, as no part lies in the middle. */
    unsigned int n_parts(const WetQuad &quad, const WaterMesh &mesh, const double h)
    {
      double size = 0.;
      for (unsigned int k = 0; k < 4; ++k)
      {
        Vector3 edge = quad.corners[(k + 1) % 4] - quad.corners[k];
        edge[1] *= mesh.is_slice ? 0. : 1.;
        size = std::max(size, norm(edge));
      }
      const unsigned int n = std::max(1., std::ceil(4. * size / h));
      return mesh.is_slice ? n + n % 2 : n;
    }

    /** Finds the water node of a part of the dam's face. Nodes of the water line have no pressure, but their area
     * counts. */
    class NodeFinder
    {
    public:
      NodeFinder(const WaterMesh &mesh, const double h) : of_file(mesh.of_file)
      {
        std::map<int, std::vector<Vector3>> points;
        double                              right = INFINITY, left = -INFINITY;
        for (unsigned int i = 0; i < mesh.n_wet(); ++i)
        {
          right = std::min(right, mesh.points[i][1]), left = std::max(left, mesh.points[i][1]);
          nodes[mesh.monolith[i]].push_back(i);
          points[mesh.monolith[i]].push_back(seen(mesh.points[i]));
        }
        for (const auto &[monolith, its_points] : points)
          finders.try_emplace(monolith, its_points, 4. * h);
        middle = .5 * (right + left);
      }

      /** Returns the nearest node of the monolith within four element sizes, or rigid_ground. Of two nodes at the same
       * distance it is the one nearer to the middle of the face, and then the lower one. */
      unsigned int find(Vector3 p, const int monolith) const
      {
        p[1] += p[1] < middle ? 2e-6 : -2e-6, p[2] -= 1e-6;
        const auto         finder = finders.find(monolith);
        const unsigned int found = finder == finders.end() ? PointFinder::none : finder->second.find(seen(p));
        return found == PointFinder::none ? rigid_ground : nodes.at(monolith)[found];
      }

    private:
      /** Returns the point as seen along the river, in a channel. Faces in a mesh file can be parallel to the river. */
      Vector3 seen(const Vector3 &p) const { return {{of_file ? p[0] : 0., p[1], p[2]}}; }

      const bool                               of_file;
      double                                   middle; ///< of the water nodes, y [m]
      std::map<int, std::vector<unsigned int>> nodes;  ///< by monolith
      std::map<int, PointFinder>               finders;
    };
  } // namespace

  std::vector<WetQuad> wet_quads(const SolidModel &dam)
  {
    std::vector<WetQuad> result;
    for (const FaceQuad &quad : face_quads(dam, PhysicalId::upstream))
    {
      WetQuad wet;
      for (unsigned int k = 0; k < 4; ++k)
        wet.corners[k] = place_of(dam, quad.nodes[k]);
      wet.monolith = quad.block;
      result.push_back(wet);
    }
    return result;
  }

  WaterCoupling::WaterCoupling(const SolidModel &dam, const WaterMesh &mesh, const double level,
                               const double h)
      : area(mesh.n_wet(), Vector3{})
  {
    const NodeFinder                                         finder(mesh, h);
    std::map<std::pair<unsigned int, unsigned int>, Vector3> areas; // by water node and node of the model
    const auto                                               quads = face_quads(dam, PhysicalId::upstream);
    const auto                                               wet = wet_quads(dam);
    for (std::size_t f = 0; f < quads.size(); ++f)
    {
      const auto        &x = wet[f].corners;
      const unsigned int n = n_parts(wet[f], mesh, h);
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int b = 0; b < n; ++b)
        {
          const double                s = (a + .5) / n, t = (b + .5) / n;
          const std::array<double, 4> N = {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
          Vector3                     p{}, along, up;
          for (unsigned int d = 0; d < 3; ++d)
          {
            for (unsigned int k = 0; k < 4; ++k)
              p[d] += N[k] * x[k][d];
            along[d] = ((1 - t) * (x[1][d] - x[0][d]) + t * (x[2][d] - x[3][d])) / n;
            up[d] = ((1 - s) * (x[3][d] - x[0][d]) + s * (x[2][d] - x[1][d])) / n;
          }
          if (p[2] >= level)
            continue;
          const Vector3 part =
              quads[f].is_clockwise ? cross(along, up) : cross(up, along); // out of the water
          const unsigned int water = finder.find(p, wet[f].monolith);
          if (water == rigid_ground)
            throw CoarseWater(
                "Mesh of the water: " + physical_name(3, wet[f].monolith) +
                " has no water node near y = " + number_text(p[1]) + " m, z = " + number_text(p[2]) + " m." +
                (mesh.of_file ? " Water volumes of a mesh file must touch every monolith." : ""));
          add(area[water], part);
          for (unsigned int k = 0; k < 4; ++k)
            for (unsigned int d = 0; d < 3; ++d)
              areas[{water, quads[f].nodes[k]}][d] += N[k] * part[d];
        }
    }
    for (const auto &[nodes, unused] : areas)
      if (dam.equation[nodes.second] != rigid_ground)
        dam_nodes.push_back(dam.equation[nodes.second]);
    std::sort(dam_nodes.begin(), dam_nodes.end());
    dam_nodes.erase(std::unique(dam_nodes.begin(), dam_nodes.end()), dam_nodes.end());
    nearest.assign(dam.n_nodes(), rigid_ground);
    for (const auto &[nodes, vector] : areas)
    {
      const auto [water, node] = nodes;
      const unsigned int equation = dam.equation[node];
      const auto         found = std::lower_bound(dam_nodes.begin(), dam_nodes.end(), equation);
      const bool         is_free = equation != rigid_ground;
      shares.push_back({water, node,
                        is_free ? static_cast<unsigned int>(found - dam_nodes.begin()) : rigid_ground,
                        vector});
    }
    for (std::size_t f = 0; f < quads.size(); ++f)
      for (unsigned int k = 0; k < 4; ++k)
        if (const Vector3 &x = wet[f].corners[k]; x[2] < level)
          nearest[quads[f].nodes[k]] = finder.find(x, wet[f].monolith);
  }

  std::vector<double> WaterCoupling::source(const WaterModel &water, const Unknowns &x) const
  {
    std::vector<double> result(water.n_nodes(), 0.);
    for (const WaterCoupling::Share &share : shares)
      if (share.wet != rigid_ground)
        result[share.water] += water.density * dot(share.area, get(x, dam_nodes[share.wet]));
    return result;
  }

  void WaterCoupling::add_incompressible_mass(const WaterModel &water, const Unknowns &x, Unknowns &y) const
  {
    const std::vector<double> potential = water.solve(source(water, x));
    for (const WaterCoupling::Share &share : shares)
      for (unsigned int c = 0; c < 3 && share.wet != rigid_ground; ++c)
        y[3 * std::size_t(dam_nodes[share.wet]) + c] +=
            water.density * share.area[c] * potential[share.water];
  }

  double WaterCoupling::critical_step(const WaterModel &water, const double of_dam,
                                      const std::vector<double> &mass) const
  {
    std::vector<double> at_node(mass.size(), 0.), row(water.n_nodes(), 0.);
    for (const WaterCoupling::Share &share : shares)
      if (share.wet != rigid_ground && !water.at_surface[share.water])
        at_node[dam_nodes[share.wet]] += norm(share.area);
    double square = 0.;
    for (const WaterCoupling::Share &share : shares)
      if (share.wet != rigid_ground && !water.at_surface[share.water])
      {
        const unsigned int node = dam_nodes[share.wet];
        double            &sum = row[share.water];
        sum += water.density * water.density * norm(share.area) * at_node[node] /
               (mass[node] * water.mass[share.water]);
        square = std::max(square, sum);
      }
    const double of_d = 4. / (of_dam * of_dam), of_w = 4. / (water.critical_step * water.critical_step),
                 middle = .5 * (of_d + square + of_w), half = .5 * (of_d - square - of_w);
    return 2. / std::sqrt(middle + std::sqrt(half * half + of_d * square));
  }
} // namespace Voussoir
