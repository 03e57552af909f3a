// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/rock/rock_grid.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  RockGrid::RockGrid(const HexMesh &mesh, const RockParameters &parameters)
      : mesh(mesh), in_region(mesh.cells.size()), cells_of_node(mesh.nodes.size())
  {
    for (unsigned int k = 0; k < mesh.cells.size(); ++k)
    {
      in_region[k] = parameters.materials.count(mesh.cells[k].volume) > 0;
      if (in_region[k])
        for (const unsigned int node : mesh.cells[k].nodes)
          cells_of_node[node].push_back(k);
    }
  }

  unsigned int RockGrid::corner(const unsigned int cell, const unsigned int node) const
  {
    const auto &nodes = mesh.cells[cell].nodes;
    return std::find(nodes.begin(), nodes.end(), node) - nodes.begin();
  }

  bool RockGrid::share_a_cell(const unsigned int a, const unsigned int b) const
  {
    for (const unsigned int k : cells_of_node[a])
      if (corner(k, b) < 8)
        return true;
    return false;
  }

  unsigned int RockGrid::next(const unsigned int a, const unsigned int b) const
  {
    unsigned int found = no_node;
    for (const unsigned int k : cells_of_node[b])
      for (const unsigned int v : corners_beside[corner(k, b)])
      {
        const unsigned int node = mesh.cells[k].nodes[v];
        if (node == found || share_a_cell(a, node))
          continue;
        if (found != no_node)
          return no_node; // not a regular node
        found = node;
      }
    return found;
  }

  std::vector<unsigned int> RockGrid::line(const unsigned int a, const unsigned int b,
                                           const std::size_t n) const
  {
    std::vector<unsigned int> nodes = {a, b};
    while (nodes.size() < n)
    {
      const unsigned int node = next(nodes[nodes.size() - 2], nodes.back());
      if (node == no_node)
        break;
      nodes.push_back(node);
    }
    return nodes;
  }

  std::vector<ArtificialFace> artificial_faces(const RockGrid &grid)
  {
    const HexMesh              &mesh = grid.mesh;
    const FaceTable             table(mesh);
    std::vector<ArtificialFace> faces;
    for (const HexMesh::Face &face : mesh.faces)
      if (face.surface == PhysicalId::artificial)
      {
        const auto owners = table.owners(face.nodes);
        for (const auto *owner : {owners.first, owners.second})
          if (owner != nullptr && grid.in_region[owner->cell])
          {
            ArtificialFace f;
            f.cell = owner->cell;
            for (unsigned int i = 0; i < 4; ++i)
              f.nodes[i] = mesh.cells[f.cell].nodes[hex_faces[owner->cell_face][i]];
            const Vector3 p = mesh.nodes[f.nodes[2]] - mesh.nodes[f.nodes[0]],
                          q = mesh.nodes[f.nodes[3]] - mesh.nodes[f.nodes[1]];
            f.normal = {{p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]}};
            const double size = norm(f.normal);
            for (double &x : f.normal)
              x /= size;
            f.area = .5 * size;
            faces.push_back(f);
          }
      }
    std::stable_sort(faces.begin(), faces.end(),
                     [](const ArtificialFace &a, const ArtificialFace &b) { return a.rank() < b.rank(); });
    return faces;
  }

  std::vector<unsigned int> layers_of_cells(const RockGrid &grid, const std::vector<ArtificialFace> &faces)
  {
    const HexMesh            &mesh = grid.mesh;
    std::vector<unsigned int> layer(mesh.cells.size(), no_node);
    std::vector<bool>         reached(mesh.nodes.size(), false);
    std::vector<unsigned int> front;
    const auto                reach = [&](const unsigned int node)
    {
      if (!reached[node])
        front.push_back(node);
      reached[node] = true;
    };
    for (const ArtificialFace &face : faces)
      for (const unsigned int node : face.nodes)
        reach(node);
    for (unsigned int number = 1; !front.empty(); ++number)
    {
      const std::vector<unsigned int> nodes = std::move(front);
      front.clear();
      for (const unsigned int node : nodes)
        for (const unsigned int k : grid.cells_of_node[node])
          if (layer[k] == no_node)
          {
            layer[k] = number;
            for (const unsigned int other : mesh.cells[k].nodes)
              reach(other);
          }
    }
    return layer;
  }

  unsigned int node_behind(const RockGrid &grid, const ArtificialFace &face, const unsigned int node)
  {
    const auto &nodes = grid.mesh.cells[face.cell].nodes;
    for (const unsigned int v : corners_beside[grid.corner(face.cell, node)])
      if (std::find(face.nodes.begin(), face.nodes.end(), nodes[v]) == face.nodes.end())
        return nodes[v];
    return no_node;
  }
} // namespace Voussoir
