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

  namespace
  {
    /** Face of a section, with the cell behind it. */
    struct EdgeFace
    {
      const HexMesh::Face *face;
      unsigned int         cell, axis;
      int                  sense; ///< the outward normal has the direction sense times axis

      bool has(const unsigned int node) const
      {
        return std::find(face->nodes.begin(), face->nodes.end(), node) != face->nodes.end();
      }
    };

    /** Returns the node of a cell at the other end of the edge that leads from the corner @p v to the face,
     * or away from the face. */
    unsigned int across(const EdgeFace &edge, const HexMesh::Cell &cell, const unsigned int v)
    {
      const unsigned int first = v / 4 * 4;
      for (const unsigned int w : {first + (v + 1) % 4, first + (v + 3) % 4, (v + 4) % 8})
        if (edge.has(cell.nodes[w]) != edge.has(cell.nodes[v]))
          return cell.nodes[w];
      return cell.nodes[v];
    }

    std::vector<EdgeFace> edge_faces(const HexMesh &section)
    {
      const FaceTable       table(section);
      std::vector<EdgeFace> result;
      for (const HexMesh::Face &face : section.faces)
      {
        EdgeFace      edge{&face, table.owners(face.nodes).first->cell, 0, 1};
        const Vector3 outward = centre(section, face.nodes) - centre(section, section.cells[edge.cell].nodes);
        for (unsigned int d = 1; d < 3; ++d)
          if (std::abs(outward[d]) > std::abs(outward[edge.axis]))
            edge.axis = d;
        edge.sense = outward[edge.axis] < 0. ? -1 : 1;
        result.push_back(edge);
      }
      return result;
    }

    /** Extrudes the faces of one side of the section along the axis. */
    void extrude(WideSection &wide, const unsigned int axis, const int sense, const unsigned int n_layers)
    {
      const HexMesh                                     before = wide.mesh;
      HexMesh                                          &mesh = wide.mesh;
      std::map<unsigned int, std::vector<unsigned int>> copies; // node -> itself and its copies in the layers
      const auto copy = [&](const unsigned int node, const unsigned int inside)
      {
        std::vector<unsigned int> &line = copies[node];
        if (!line.empty())
          return;
        line.push_back(node);
        for (unsigned int k = 1; k <= n_layers; ++k)
        {
          line.push_back(mesh.nodes.size());
          mesh.nodes.push_back(before.nodes[node]);
          mesh.nodes.back()[axis] += k * (before.nodes[node][axis] - before.nodes[inside][axis]);
          wide.root.push_back(wide.root[node]);
          wide.is_below.push_back(wide.is_below[node] || axis == 2);
        }
      };
      const std::vector<EdgeFace>                     edges = edge_faces(before);
      std::set<std::pair<unsigned int, unsigned int>> other_edges; // of faces with another direction
      mesh.faces.clear();
      for (const EdgeFace &edge : edges)
        if (edge.axis != axis || edge.sense != sense)
        {
          mesh.faces.push_back(*edge.face);
          for (unsigned int i = 0; i < 4; ++i)
            other_edges.insert(std::minmax(edge.face->nodes[i], edge.face->nodes[(i + 1) % 4]));
        }
      for (const EdgeFace &edge : edges)
        if (edge.axis == axis && edge.sense == sense)
        {
          const HexMesh::Cell &cell = before.cells[edge.cell];
          for (unsigned int v = 0; v < 8; ++v)
            if (edge.has(cell.nodes[v]))
              copy(cell.nodes[v], across(edge, cell, v));
          for (unsigned int k = 1; k <= n_layers; ++k)
          {
            HexMesh::Cell added = cell;
            for (unsigned int v = 0; v < 8; ++v)
              added.nodes[v] =
                  edge.has(cell.nodes[v]) ? copies[cell.nodes[v]][k] : copies[across(edge, cell, v)][k - 1];
            mesh.cells.push_back(added);
          }
          HexMesh::Face outer = *edge.face;
          for (unsigned int i = 0; i < 4; ++i)
          {
            const unsigned int a = edge.face->nodes[i], b = edge.face->nodes[(i + 1) % 4];
            outer.nodes[i] = copies[a][n_layers];
            for (unsigned int k = 1; k <= n_layers && other_edges.count(std::minmax(a, b)); ++k)
              mesh.faces.push_back(
                  {{copies[a][k - 1], copies[b][k - 1], copies[b][k], copies[a][k]}, PhysicalId::artificial});
          }
          mesh.faces.push_back(outer);
        }
    }
  } // namespace

  namespace
  {
    /** Returns the number of layers of cells that have the given width on one side of the section, but not
     * less than @p least. */
    unsigned int layers_of_zone(const HexMesh &section, const unsigned int axis, const int sense,
                                const double width, const unsigned int least)
    {
      double size = 0.;
      for (const EdgeFace &edge : edge_faces(section))
      {
        const HexMesh::Cell &cell = section.cells[edge.cell];
        for (unsigned int v = 0; v < 8 && edge.axis == axis && edge.sense == sense; ++v)
          if (edge.has(cell.nodes[v]))
            size = std::max(size, std::abs(section.nodes[cell.nodes[v]][axis] -
                                           section.nodes[across(edge, cell, v)][axis]));
      }
      return size > 0. ? std::max<unsigned int>(least, std::lround(width / size)) : least;
    }
  } // namespace

  WideSection widened(const HexMesh &section, const unsigned int direction, const double width,
                      const unsigned int least)
  {
    WideSection wide{section,
                     {},
                     std::vector<bool>(section.nodes.size(), false),
                     section.nodes.size(),
                     section.cells.size()};
    for (unsigned int i = 0; i < section.nodes.size(); ++i)
      wide.root.push_back(i);
    for (const auto &[axis, sense] :
         {std::pair<unsigned int, int>(1 - direction, -1), {1 - direction, 1}, {2, -1}})
    {
      const unsigned int n = layers_of_zone(section, axis, sense, width, least);
      extrude(wide, axis, sense, n);
      wide.n_layers = std::max(wide.n_layers, n);
    }
    return wide;
  }
} // namespace Voussoir
