// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/grid/grid_tools.h>

#include <voussoir/solid/triangulation.h>

#include <algorithm>

namespace Voussoir
{
  using namespace dealii;

  namespace
  {
    using Key = std::array<unsigned int, 4>;

    Key sorted(Key nodes)
    {
      std::sort(nodes.begin(), nodes.end());
      return nodes;
    }

    void set_boundary_ids(const HexMesh &mesh, const std::vector<unsigned int> &nodes,
                          Triangulation<3> &triangulation)
    {
      std::map<Key, int> surface_of;
      for (const HexMesh::Face &face : mesh.faces)
        surface_of[sorted(face.nodes)] = face.surface;
      for (const auto &cell : triangulation.active_cell_iterators())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
          {
            Key key;
            for (unsigned int v = 0; v < 4; ++v)
              key[v] = nodes[cell->face(f)->vertex_index(v)];
            const auto found = surface_of.find(sorted(key));
            cell->face(f)->set_boundary_id(found == surface_of.end() ? 0 : found->second);
          }
    }
  } // namespace

  std::vector<unsigned int> make_triangulation(const HexMesh &mesh, const std::vector<unsigned int> &cells,
                                               Triangulation<3> &triangulation)
  {
    constexpr unsigned int    unused = static_cast<unsigned int>(-1);
    std::vector<unsigned int> vertex(mesh.nodes.size(), unused), nodes;
    for (const unsigned int k : cells)
      for (const unsigned int node : mesh.cells[k].nodes)
        vertex[node] = 0;
    std::vector<Point<3>> vertices;
    for (unsigned int i = 0; i < vertex.size(); ++i)
      if (vertex[i] != unused)
      {
        vertex[i] = nodes.size();
        nodes.push_back(i);
        vertices.emplace_back(mesh.nodes[i][0], mesh.nodes[i][1], mesh.nodes[i][2]);
      }

    constexpr unsigned int   lexicographic[8] = {0, 1, 3, 2, 4, 5, 7, 6};
    std::vector<CellData<3>> data(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      data[i].material_id = mesh.cells[cells[i]].volume;
      for (unsigned int v = 0; v < 8; ++v)
        data[i].vertices[lexicographic[v]] = vertex[mesh.cells[cells[i]].nodes[v]];
    }
    GridTools::consistently_order_cells(data);
    triangulation.create_triangulation(vertices, data, SubCellData());
    set_boundary_ids(mesh, nodes, triangulation);
    return nodes;
  }
} // namespace Voussoir
