// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <voussoir/rock/rock_grid.h>
#include <voussoir/solid/triangulation.h>

#include <algorithm>

namespace Voussoir
{
  using namespace dealii;

  RockGrid::RockGrid(const HexMesh &mesh, const RockParameters &parameters,
                     const std::vector<unsigned int> &master)
      : fe(1), dof_handler(triangulation)
  {
    std::vector<unsigned int> cells;
    for (unsigned int k = 0; k < mesh.cells.size(); ++k)
      if (parameters.materials.count(mesh.cells[k].volume))
        cells.push_back(k);
    mesh_node = make_triangulation(mesh, cells, triangulation);

    dof_handler.distribute_dofs(fe);
    std::vector<types::global_dof_index> vertex_of_dof(dof_handler.n_dofs());
    for (const Cell &cell : dof_handler.active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        vertex_of_dof[cell->vertex_dof_index(v, 0)] = cell->vertex_index(v);
    dof_handler.renumber_dofs(vertex_of_dof);

    constexpr unsigned int    none = static_cast<unsigned int>(-1);
    std::vector<unsigned int> of_master(mesh.nodes.size(), none);
    for (const unsigned int i : mesh_node)
    {
      unsigned int &number = of_master[master.empty() ? i : master[i]];
      if (number == none)
      {
        number = points.size();
        points.push_back(mesh.nodes[i]);
      }
      node_of_dof.push_back(number);
    }
  }

  std::vector<ArtificialFace> artificial_faces(const RockGrid &grid)
  {
    constexpr unsigned int      around[4] = {0, 1, 3, 2}; // corners of a face, seen against its axis
    FEFaceValues<3>             values(grid.fe, QGauss<2>(2), update_normal_vectors | update_JxW_values);
    std::vector<ArtificialFace> faces;
    for (const RockGrid::Cell &cell : grid.dof_handler.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == PhysicalId::artificial)
        {
          values.reinit(cell, f);
          Tensor<1, 3> area;
          for (const unsigned int q : values.quadrature_point_indices())
            area += values.JxW(q) * values.normal_vector(q);
          ArtificialFace face{cell, f, {}, {}, area.norm()};
          for (unsigned int d = 0; d < 3; ++d)
            face.normal[d] = area[d] / face.area;
          const bool is_lower = f % 2 == 0; // the axis points inward
          for (unsigned int i = 0; i < 4; ++i)
            face.corners[is_lower ? 3 - i : i] = GeometryInfo<3>::face_to_cell_vertices(f, around[i]);
          faces.push_back(face);
        }
    std::stable_sort(faces.begin(), faces.end(),
                     [](const ArtificialFace &a, const ArtificialFace &b) { return a.rank() < b.rank(); });
    return faces;
  }

  InwardLine inward_line(const RockGrid &grid, const ArtificialFace &face, const unsigned int corner,
                         const std::size_t n)
  {
    RockGrid::Cell cell = face.cell;
    unsigned int   f = face.face, v = corner;
    InwardLine     line{{grid.node(cell, v)}, {cell->vertex(v)}, {}};
    while (line.nodes.size() < n)
    {
      v ^= 1u << f / 2; // other end of the edge that leaves the face
      line.nodes.push_back(grid.node(cell, v));
      line.places.push_back(cell->vertex(v));
      line.cells.push_back(cell);
      const unsigned int opposite = GeometryInfo<3>::opposite_face[f], vertex = cell->vertex_index(v);
      if (cell->at_boundary(opposite))
        break;
      f = cell->neighbor_of_neighbor(opposite);
      cell = cell->neighbor(opposite);
      for (v = 0; cell->vertex_index(v) != vertex;)
        ++v;
    }
    return line;
  }

  namespace
  {
    /** Returns for each active cell whether it lies within @p n_layers layers of cells around the vertices
     * that are @p reached. */
    std::vector<bool> cells_about(const RockGrid &grid, std::vector<bool> reached,
                                  const unsigned int n_layers)
    {
      std::vector<bool> found(grid.triangulation.n_active_cells(), false);
      for (unsigned int layer = 0; layer < n_layers; ++layer)
      {
        const std::vector<bool> before = reached;
        for (const auto &cell : grid.triangulation.active_cell_iterators())
          if (const auto vertices = cell->vertex_indices();
              !found[cell->active_cell_index()] &&
              std::any_of(vertices.begin(), vertices.end(),
                          [&](const unsigned int v) { return before[cell->vertex_index(v)]; }))
          {
            found[cell->active_cell_index()] = true;
            for (const unsigned int v : vertices)
              reached[cell->vertex_index(v)] = true;
          }
        if (reached == before)
          break; // no more layers
      }
      return found;
    }
  } // namespace

  std::vector<bool> cells_at_boundary(const RockGrid &grid, const std::vector<ArtificialFace> &faces,
                                      const unsigned int n_layers)
  {
    std::vector<bool> reached(grid.triangulation.n_vertices(), false);
    for (const ArtificialFace &face : faces)
      for (const unsigned int v : face.corners)
        reached[face.cell->vertex_index(v)] = true;
    return cells_about(grid, std::move(reached), n_layers);
  }

  std::vector<bool> cells_at_dam(const RockGrid &grid, const unsigned int n_layers)
  {
    std::vector<bool> reached(grid.triangulation.n_vertices(), false);
    for (const auto &cell : grid.triangulation.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (const auto face = cell->face(f);
            face->at_boundary() && is_base(static_cast<int>(face->boundary_id())))
          for (const unsigned int v : face->vertex_indices())
            reached[face->vertex_index(v)] = true;
    return cells_about(grid, std::move(reached), n_layers);
  }
} // namespace Voussoir
