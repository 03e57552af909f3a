// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/rock/rock_model.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace Voussoir
{
  namespace
  {
    /** Gradients of the eight shape functions at a point of the unit cell [1/m]; returns det J [m^3]. */
    double gradients(const HexMesh &mesh, const HexMesh::Cell &cell, const Vector3 &xi,
                     std::array<Vector3, 8> &gradient)
    {
      Matrix3                jacobian{};
      std::array<Vector3, 8> reference;
      for (unsigned int v = 0; v < 8; ++v)
        for (unsigned int a = 0; a < 3; ++a)
        {
          double derivative = 2. * unit_cube[v][a] - 1.;
          for (unsigned int b = 0; b < 3; ++b)
            if (b != a)
              derivative *= unit_cube[v][b] ? xi[b] : 1. - xi[b];
          reference[v][a] = derivative;
          for (unsigned int c = 0; c < 3; ++c)
            jacobian[3 * a + c] += derivative * mesh.nodes[cell.nodes[v]][c];
        }
      const Matrix3 inverted = inverse(jacobian); // d xi_a / d x_c at 3 c + a
      for (unsigned int v = 0; v < 8; ++v)
        gradient[v] = inverted * reference[v];
      const Matrix3 &j = jacobian;
      return j[0] * (j[4] * j[8] - j[5] * j[7]) - j[1] * (j[3] * j[8] - j[5] * j[6]) +
             j[2] * (j[3] * j[7] - j[4] * j[6]);
    }

    void number_nodes(const RockGrid &grid, const std::vector<unsigned int> &master, RockModel &model)
    {
      const auto &nodes = grid.mesh.nodes;
      model.node.assign(nodes.size(), no_node);
      std::vector<unsigned int> of_master(nodes.size(), no_node);
      for (unsigned int i = 0; i < nodes.size(); ++i)
        if (!grid.cells_of_node[i].empty())
        {
          unsigned int &number = of_master[master.empty() ? i : master[i]];
          if (number == no_node)
          {
            number = model.points.size();
            model.points.push_back(nodes[i]);
          }
          model.node[i] = number;
        }
    }

    /** For each node of the region its (cell, corner) pairs. */
    using Corners = std::vector<std::vector<std::pair<unsigned int, unsigned int>>>;

    Corners corners_of_nodes(const RockGrid &grid, const RockModel &model)
    {
      Corners corners(model.points.size());
      for (unsigned int k = 0; k < grid.mesh.cells.size(); ++k)
        if (grid.in_region[k])
          for (unsigned int v = 0; v < 8; ++v)
            corners[model.node[grid.mesh.cells[k].nodes[v]]].emplace_back(k, v);
      return corners;
    }

    /** Nodal quadrature does not couple the two ends of a cell's diagonal. */
    BlockSparseMatrix pattern(const HexMesh &mesh, const RockModel &model, const Corners &corners,
                              const std::vector<bool> &nodal)
    {
      std::vector<std::vector<unsigned int>> columns(corners.size());
      const int                              n = corners.size();
#pragma omp parallel for schedule(static)
      for (int row = 0; row < n; ++row)
      {
        for (const auto &corner : corners[row])
          for (unsigned int v = 0; v < 8; ++v)
            if (!nodal[corner.first] || v != opposite_corner[corner.second])
              columns[row].push_back(model.node[mesh.cells[corner.first].nodes[v]]);
        std::sort(columns[row].begin(), columns[row].end());
        columns[row].erase(std::unique(columns[row].begin(), columns[row].end()), columns[row].end());
      }
      return BlockSparseMatrix(columns);
    }

    /** Adds the stiffness and the mass that corner @p v of a cell has. */
    void add_corner(const HexMesh &mesh, const HexMesh::Cell &cell, const Material &material,
                    const bool nodal, const unsigned int v, const unsigned int row, RockModel &model)
    {
      const double           e = material.young, nu = material.poisson;
      const double           lambda = e * nu / ((1. + nu) * (1. - 2. * nu)), mu = e / (2. * (1. + nu));
      const double           gauss[2] = {.5 - .5 / std::sqrt(3.), .5 + .5 / std::sqrt(3.)};
      std::array<Vector3, 8> gradient;
      for (unsigned int q = 0; q < 8; ++q)
      {
        Vector3 xi;
        for (unsigned int d = 0; d < 3; ++d)
          xi[d] = gauss[unit_cube[q][d]];
        double shape = 1.;
        for (unsigned int d = 0; d < 3; ++d)
          shape *= unit_cube[v][d] ? xi[d] : 1. - xi[d];
        double jacobian = gradients(mesh, cell, xi, gradient);
        model.mass[row] += material.density * shape * jacobian / 8.;
        if (nodal)
        {
          if (q != v && std::find(corners_beside[q], corners_beside[q] + 3, v) == corners_beside[q] + 3)
            continue; // the gradient vanishes there
          for (unsigned int d = 0; d < 3; ++d)
            xi[d] = unit_cube[q][d];
          jacobian = gradients(mesh, cell, xi, gradient);
        }
        const double   weight = jacobian / 8.;
        const Vector3 &g = gradient[v];
        for (unsigned int w = 0; w < 8; ++w)
        {
          const Vector3 &h = gradient[w];
          const double   gh = mu * (g[0] * h[0] + g[1] * h[1] + g[2] * h[2]);
          if (nodal && w == opposite_corner[v])
            continue;
          Matrix3 block;
          for (unsigned int a = 0; a < 3; ++a)
            for (unsigned int b = 0; b < 3; ++b)
              block[3 * a + b] = weight * (lambda * g[a] * h[b] + mu * g[b] * h[a] + (a == b ? gh : 0.));
          model.stiffness.add(row, model.node[cell.nodes[w]], block);
        }
      }
    }

    void assemble(const RockGrid &grid, const RockParameters &parameters, RockModel &model)
    {
      const HexMesh    &mesh = grid.mesh;
      std::vector<bool> nodal(mesh.cells.size());
      for (unsigned int k = 0; k < mesh.cells.size(); ++k)
        nodal[k] = parameters.nodal_everywhere ||
                   (model.layer[k] != no_node && model.layer[k] <= parameters.nodal_layers);
      const Corners corners = corners_of_nodes(grid, model);
      model.stiffness = pattern(mesh, model, corners, nodal);
      model.mass.assign(model.points.size(), 0.);
      const int n = corners.size();
#pragma omp parallel for schedule(dynamic, 256)
      for (int row = 0; row < n; ++row)
        for (const auto &corner : corners[row])
        {
          const HexMesh::Cell &cell = mesh.cells[corner.first];
          add_corner(mesh, cell, parameters.materials.at(cell.volume), nodal[corner.first], corner.second,
                     row, model);
        }
      model.stiffness.symmetrise();
    }

    void find_lines(const RockGrid &grid, const std::vector<ArtificialFace> &faces,
                    const RockParameters &parameters, RockModel &model)
    {
      const HexMesh         &mesh = grid.mesh;
      std::set<unsigned int> done;
      constexpr std::size_t  longest = 9; // nodes, for order 4
      for (const ArtificialFace &face : faces)
        for (const unsigned int node : face.nodes)
          if (done.insert(model.node[node]).second)
          {
            BoundaryLine line;
            double       along = 0.;
            unsigned int last = node;
            for (const unsigned int i : grid.line(node, node_behind(grid, face, node), longest))
            {
              along += norm(mesh.nodes[i] - mesh.nodes[last]);
              line.nodes.push_back(model.node[i]);
              line.position.push_back(along);
              last = i;
            }
            const Material &material = parameters.materials.at(mesh.cells[face.cell].volume);
            line.c_p = p_wave_speed(material);
            line.c_s = s_wave_speed(material);
            line.distance = norm(mesh.nodes[node] - parameters.centre);
            model.lines.push_back(line);
          }
    }

    /** The vertical grid line that begins behind a face of the bottom. */
    RockColumn column_above(const RockGrid &grid, const ArtificialFace &face, const unsigned int foot,
                            const RockParameters &parameters, const RockModel &model)
    {
      RockColumn   column;
      unsigned int last = no_node;
      for (const unsigned int i :
           grid.line(foot, node_behind(grid, face, foot), std::numeric_limits<std::size_t>::max()))
      {
        column.nodes.push_back(model.node[i]);
        column.z.push_back(grid.mesh.nodes[i][2]);
        if (last != no_node)
          for (const unsigned int k : grid.cells_of_node[last])
            if (grid.corner(k, i) < 8)
            {
              column.material.push_back(parameters.materials.at(grid.mesh.cells[k].volume));
              break;
            }
        last = i;
      }
      return column;
    }

    /** Columns at the feet of the side faces; one anywhere if there are no side faces. */
    void find_columns(const RockGrid &grid, const std::vector<ArtificialFace> &faces,
                      const RockParameters &parameters, RockModel &model)
    {
      std::set<unsigned int> side, done;
      for (const ArtificialFace &face : faces)
        if (face.rank() < 2)
          for (const unsigned int node : face.nodes)
            side.insert(model.node[node]);
      for (const ArtificialFace &face : faces)
        if (face.rank() == 2)
          for (const unsigned int node : face.nodes)
            if ((side.count(model.node[node]) || (side.empty() && model.columns.empty())) &&
                done.insert(model.node[node]).second)
              model.columns.push_back(column_above(grid, face, node, parameters, model));
      std::map<unsigned int, RockModel::Place> place;
      for (unsigned int c = 0; c < model.columns.size(); ++c)
        for (unsigned int k = 0; k < model.columns[c].nodes.size(); ++k)
          place.insert({model.columns[c].nodes[k], {c, k}});
      for (const BoundaryLine &line : model.lines)
      {
        const auto found = place.find(line.nodes[0]);
        const bool on_side = side.count(line.nodes[0]) > 0;
        model.place.push_back(on_side && found != place.end() ? found->second
                                                              : RockModel::Place{no_node, no_node});
      }
    }
  } // namespace

  RockModel make_rock_model(const HexMesh &mesh, const RockParameters &parameters,
                            const std::vector<unsigned int> &master)
  {
    const RockGrid                    grid(mesh, parameters);
    const std::vector<ArtificialFace> faces = artificial_faces(grid);
    RockModel                         model;
    number_nodes(grid, master, model);
    model.layer = layers_of_cells(grid, faces);
    assemble(grid, parameters, model);
    find_lines(grid, faces, parameters, model);
    find_columns(grid, faces, parameters, model);
    for (const ArtificialFace &face : faces)
    {
      BoundaryFace f{{}, face.normal, face.area, parameters.materials.at(mesh.cells[face.cell].volume)};
      for (unsigned int i = 0; i < 4; ++i)
        f.nodes[i] = model.node[face.nodes[i]];
      model.faces.push_back(f);
    }
    return model;
  }
} // namespace Voussoir
