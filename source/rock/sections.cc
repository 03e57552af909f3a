// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/rock/rock_grid.h>
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
        for (const unsigned int w : corners_beside[v])
        {
          // The edge that is most nearly along the direction joins the two copies.
          const unsigned int a = cell.nodes[v], b = cell.nodes[w];
          const Vector3      d = mesh.nodes[b] - mesh.nodes[a];
          if (std::abs(d[direction]) > .99 * norm(d))
            master[a] = master[b] = std::min(a, b);
        }
    return master;
  }

  HexMesh extruded_section(const HexMesh &mesh, const RockParameters &parameters,
                           const unsigned int direction, const int sense)
  {
    const RockGrid                    grid(mesh, parameters);
    const std::vector<ArtificialFace> all = artificial_faces(grid);
    std::vector<ArtificialFace>       cut;
    double                            thickness = 0.;
    for (const ArtificialFace &face : all)
      if (sense * face.normal[direction] > .7)
      {
        cut.push_back(face);
        thickness = std::max(thickness, std::sqrt(face.area));
      }

    HexMesh section;
    section.zones = mesh.zones;
    std::map<unsigned int, unsigned int> copy; // mesh node -> its place in the section, in pairs
    for (const ArtificialFace &face : cut)
      for (const unsigned int node : face.nodes)
        if (copy.try_emplace(node, section.nodes.size()).second)
        {
          section.nodes.push_back(mesh.nodes[node]);
          section.nodes.push_back(mesh.nodes[node]);
          section.nodes.back()[direction] -= sense * thickness;
        }
    for (const ArtificialFace &face : cut) // seen from outside, the corners are counter-clockwise
    {
      HexMesh::Cell cell;
      for (unsigned int i = 0; i < 4; ++i)
      {
        cell.nodes[i] = copy[face.nodes[i]] + 1;
        cell.nodes[i + 4] = copy[face.nodes[i]];
      }
      cell.volume = mesh.cells[face.cell].volume;
      cell.zone = mesh.cells[face.cell].zone;
      section.cells.push_back(cell);
    }
    // Edges of the cut that other artificial faces share.
    std::set<std::pair<unsigned int, unsigned int>> edges;
    for (const ArtificialFace &face : all)
      if (sense * face.normal[direction] <= .7)
        for (unsigned int i = 0; i < 4; ++i)
          edges.insert(std::minmax(face.nodes[i], face.nodes[(i + 1) % 4]));
    for (const ArtificialFace &face : cut)
      for (unsigned int i = 0; i < 4; ++i)
      {
        const unsigned int a = face.nodes[i], b = face.nodes[(i + 1) % 4];
        if (edges.count(std::minmax(a, b)))
          section.faces.push_back({{copy[a], copy[b], copy[b] + 1, copy[a] + 1}, PhysicalId::artificial});
      }
    return section;
  }
} // namespace Voussoir
