// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/solid/face_quads.h>
#include <voussoir/water/water_coupling.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Voussoir
{
  namespace
  {
    Vector3 place_of(const SolidModel &dam, const unsigned int node)
    {
      return {{dam.points[node][0], dam.points[node][1], dam.points[node][2]}};
    }

    double size_of(const WetQuad &quad)
    {
      double size = 0.;
      for (unsigned int k = 0; k < 4; ++k)
        size = std::max(size, norm(quad.corners[(k + 1) % 4] - quad.corners[k]));
      return size;
    }

    /** Finds the water node of a part of the dam's face. */
    class NodeFinder
    {
    public:
      NodeFinder(const WaterSection &section, const double h) : section(section), h(h)
      {
        for (std::size_t c = 0; c < section.cells.size(); ++c)
          for (const unsigned int node : section.cells[c])
            bins[bin(section.points[node])].push_back(node);
        for (auto &[key, nodes] : bins)
        {
          std::sort(nodes.begin(), nodes.end());
          nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        }
      }

      /** Returns the nearest node of the monolith within three element sizes; it has the largest bilinear weight in
       * a square element. Nodes of the water line have no pressure, but their area counts. */
      unsigned int find(const Point2 &p, const int monolith) const
      {
        unsigned int best = rigid_ground;
        double       least = 1e300;
        for (int reach = 1; reach <= 4 && best == rigid_ground; ++reach)
        {
          const auto [i, j] = bin(p);
          for (int a = -reach; a <= reach; ++a)
            for (int b = -reach; b <= reach; ++b)
              if (const auto found = bins.find({i + a, j + b}); found != bins.end())
                for (const unsigned int node : found->second)
                  if (section.monolith[node] == monolith)
                    if (const double far =
                            std::hypot(section.points[node][0] - p[0], section.points[node][1] - p[1]);
                        far < least)
                    {
                      least = far;
                      best = node;
                    }
        }
        return best;
      }

    private:
      std::pair<int, int> bin(const Point2 &p) const
      {
        return {static_cast<int>(std::floor(p[0] / h)), static_cast<int>(std::floor(p[1] / h))};
      }

      const WaterSection                                      &section;
      const double                                             h;
      std::map<std::pair<int, int>, std::vector<unsigned int>> bins;
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
      wet.monolith = quad.monolith;
      result.push_back(wet);
    }
    return result;
  }

  WaterCoupling::WaterCoupling(const SolidModel &dam, const WaterSection &section, const double level,
                               const double h)
      : area(section.points.size(), Vector3{})
  {
    const NodeFinder                                         finder(section, h);
    std::map<std::pair<unsigned int, unsigned int>, Vector3> areas; // by water node and node of the model
    const auto                                               quads = face_quads(dam, PhysicalId::upstream);
    const auto                                               wet = wet_quads(dam);
    for (std::size_t f = 0; f < quads.size(); ++f)
    {
      const auto        &x = wet[f].corners;
      const unsigned int n = std::max(1., std::ceil(4. * size_of(wet[f]) / h));
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
          Vector3 part = {{along[1] * up[2] - along[2] * up[1], along[2] * up[0] - along[0] * up[2],
                           along[0] * up[1] - along[1] * up[0]}};
          if (part[0] < 0.) // out of the water is downstream
            part = {{-part[0], -part[1], -part[2]}};
          const unsigned int water = finder.find({p[1], p[2]}, wet[f].monolith);
          if (water == rigid_ground)
            throw InputError(
                "Mesh of the water: monolith " + std::to_string(wet[f].monolith) +
                " has no water node near y = " + number_text(p[1]) + " m, z = " + number_text(p[2]) +
                " m. Reduce Reservoir/Element size, for example to " + number_text(.7 * h) + " m.");
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
          nearest[quads[f].nodes[k]] = finder.find({x[1], x[2]}, wet[f].monolith);
  }
} // namespace Voussoir
