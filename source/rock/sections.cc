// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/rock/sections.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace Voussoir
{
  std::vector<unsigned int> tie_layer(const HexMesh &mesh, const unsigned int direction)
  {
    std::vector<unsigned int> master(mesh.nodes.size());
    for (unsigned int i = 0; i < master.size(); ++i)
      master[i] = i;
    for (const HexMesh::Cell &cell : mesh.cells)
      for (unsigned int v = 0; v < 8; ++v)
        for (const unsigned int w : {v / 4 * 4 + (v + 1) % 4, (v + 4) % 8})
        {
          // The edge closest to the direction joins the two copies.
          const unsigned int a = cell.nodes[v], b = cell.nodes[w];
          const Vector3      d = mesh.nodes[b] - mesh.nodes[a];
          if (std::abs(d[direction]) > .99 * norm(d))
            master[a] = master[b] = std::min(a, b);
        }
    return master;
  }

  HexMesh extruded_section(const RockModel &model, const unsigned int direction, const int sense)
  {
    std::vector<BoundaryFace> cut;
    double                    thickness = 0.;
    for (const BoundaryFace &face : model.faces)
      if (sense * face.normal[direction] > .7)
      {
        cut.push_back(face);
        thickness = std::max(thickness, std::sqrt(face.area));
      }

    HexMesh                              section;
    std::map<unsigned int, unsigned int> copy; // node -> index in the section, in pairs
    for (const BoundaryFace &face : cut)
      for (const unsigned int node : face.nodes)
        if (copy.try_emplace(node, section.nodes.size()).second)
        {
          section.nodes.push_back(model.points[node]);
          section.nodes.push_back(model.points[node]);
          section.nodes.back()[direction] -= sense * thickness;
        }
    for (const BoundaryFace &face : cut)
    {
      HexMesh::Cell cell{{}, face.volume};
      for (unsigned int i = 0; i < 4; ++i)
      {
        cell.nodes[i] = copy[face.nodes[i]] + 1;
        cell.nodes[i + 4] = copy[face.nodes[i]];
      }
      section.cells.push_back(cell);
    }
    // Edges of the section on other artificial faces.
    std::set<std::pair<unsigned int, unsigned int>> edges;
    for (const BoundaryFace &face : model.faces)
      if (sense * face.normal[direction] <= .7)
        for (unsigned int i = 0; i < 4; ++i)
          edges.insert(std::minmax(face.nodes[i], face.nodes[(i + 1) % 4]));
    for (const BoundaryFace &face : cut)
      for (unsigned int i = 0; i < 4; ++i)
      {
        const unsigned int a = face.nodes[i], b = face.nodes[(i + 1) % 4];
        if (edges.count(std::minmax(a, b)))
          section.faces.push_back({{copy[a], copy[b], copy[b] + 1, copy[a] + 1}, PhysicalId::artificial});
      }
    return section;
  }
} // namespace Voussoir
