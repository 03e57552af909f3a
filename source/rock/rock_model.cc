// SPDX-License-Identifier: GPL-3.0-or-later
#include "rock_assembly.h"

#include <algorithm>
#include <limits>
#include <map>

namespace Voussoir
{
  namespace
  {
    /** Returns the quadrature of all cells. Sets the numbers of cells at the dam in @p model. */
    std::vector<Integration> integrations(const RockGrid &grid, const std::vector<ArtificialFace> &faces,
                                          const RockParameters &parameters, RockModel &model)
    {
      const std::vector<bool> at_boundary = cells_at_boundary(grid, faces, parameters.nodal_layers),
                              at_dam = cells_at_dam(grid, parameters.layers_at_dam);
      std::vector<Integration> kind(at_dam.size(),
                                    parameters.nodal_everywhere ? Integration::nodal : Integration::gauss);
      for (std::size_t k = 0; k < kind.size(); ++k)
      {
        if (at_dam[k])
          kind[k] = parameters.incompatible_modes ? Integration::with_modes : Integration::gauss;
        if (at_boundary[k])
          kind[k] = Integration::nodal;
        if (parameters.plane_strain && kind[k] == Integration::nodal)
          kind[k] = Integration::nodal_plane;
        model.n_cells_at_dam += at_dam[k];
        model.n_nodal_at_dam += at_dam[k] && at_boundary[k];
      }
      return kind;
    }

    /** Returns the time that a shear wave needs along the longest edge of a cell: not more than this for 95 %
     * of the cells [s]. */
    double largest_crossing(const RockGrid &grid, const RockParameters &parameters)
    {
      std::vector<double> times;
      for (const RockGrid::Cell &cell : grid.dof_handler.active_cell_iterators())
      {
        double longest = 0.;
        for (const unsigned int line : cell->line_indices())
          longest = std::max(longest, cell->line(line)->diameter());
        times.push_back(longest / s_wave_speed(parameters.materials.at(cell->material_id())));
      }
      const auto most = times.begin() + (times.size() - 1) * 19 / 20;
      std::nth_element(times.begin(), most, times.end());
      return *most;
    }

    /** Sorts the cells with nodal quadrature, which need no matrix, into nodal_cells of the @p model. */
    void sort_cells(const RockGrid &grid, const Corners &cells, const std::vector<Integration> &kind,
                    const RockParameters &parameters, RockModel &model)
    {
      model.in_other_cell.assign(grid.n_nodes(), false);
      model.nodal_cells.reserve(std::count(kind.begin(), kind.end(), Integration::nodal));
      for (const RockGrid::Cell &cell : grid.dof_handler.active_cell_iterators())
      {
        const auto &nodes = cells[cell->active_cell_index()];
        bool        is_plain = kind[cell->active_cell_index()] == Integration::nodal;
        for (unsigned int v = 0; v < 8; ++v)
          for (unsigned int c = 0; c < 3; ++c)
            is_plain =
                is_plain && grid.points[nodes[v]][c] == cell->vertex(v)[c]; // otherwise tied to another node
        if (is_plain)
        {
          const Material &m = parameters.materials.at(cell->material_id());
          model.nodal_cells.push_back({nodes,
                                       m.young * m.poisson / ((1. + m.poisson) * (1. - 2. * m.poisson)),
                                       m.young / (2. * (1. + m.poisson))});
        }
        else
          for (const unsigned int i : nodes)
            model.in_other_cell[i] = true;
      }
    }

    /** Rocks that meet at a line, with the areas of their faces [m^2]. */
    using Rocks = std::vector<std::pair<Material, double>>;

    /** Returns the material of several rocks that move together: means of moduli and density,
     * weighted by area. */
    Material mean(const Rocks &materials)
    {
      const Material &first = materials[0].first;
      bool            is_one = true;
      double          area = 0., shear = 0., axial = 0., density = 0.; // moduli
      for (const auto &part : materials)
      {
        const Material &m = part.first;
        is_one = is_one && m.young == first.young && m.poisson == first.poisson && m.density == first.density;
        const double mu = m.young / (2. * (1. + m.poisson));
        area += part.second;
        density += part.second * m.density;
        shear += part.second * mu;
        axial += part.second * mu * 2. * (1. - m.poisson) / (1. - 2. * m.poisson);
      }
      if (is_one)
        return first;
      Material result = first;
      result.density = density / area;
      result.poisson = .5 * (axial - 2. * shear) / (axial - shear);
      result.young = 2. * (1. + result.poisson) * shear / area;
      return result;
    }

    void find_lines(const RockGrid &grid, const std::vector<ArtificialFace> &faces,
                    const RockParameters &parameters, RockModel &model)
    {
      constexpr std::size_t     longest = 9; // nodes, for order 4
      std::vector<unsigned int> line_of(grid.n_nodes(), no_node);
      std::vector<Rocks>        rocks; // rocks around each line
      const dealii::Point<3>    centre(parameters.centre[0], parameters.centre[1], parameters.centre[2]);
      for (const ArtificialFace &face : faces)
        for (const unsigned int corner : face.corners)
        {
          const InwardLine found = inward_line(grid, face, corner, longest);
          unsigned int    &k = line_of[found.nodes[0]];
          if (k == no_node)
          {
            k = model.lines.size();
            model.lines.emplace_back();
            rocks.emplace_back();
          }
          BoundaryLine    &line = model.lines[k];
          dealii::Point<3> source = centre;
          if (parameters.plane_strain)
            source[1] = found.places[0][1];
          line.distance = std::max(line.distance, found.places[0].distance(source));
          if (line.nodes.empty() || found.nodes[1] == line.nodes[1])
            rocks[k].emplace_back(parameters.materials.at(face.cell->material_id()), face.area);
          if (!line.nodes.empty() &&
              (found.nodes[1] != line.nodes[1] || found.nodes.size() <= line.nodes.size()))
            continue;
          line.nodes = found.nodes;
          line.position.assign(1, 0.);
          for (std::size_t i = 1; i < found.places.size(); ++i)
            line.position.push_back(line.position.back() + found.places[i].distance(found.places[i - 1]));
        }
      for (unsigned int k = 0; k < rocks.size(); ++k)
      {
        const Material material = mean(rocks[k]);
        model.lines[k].c_p = p_wave_speed(material);
        model.lines[k].c_s = s_wave_speed(material);
      }
    }

    /** Stack of cells on a face of the bottom, with one of its vertical lines. */
    struct Stack
    {
      InwardLine line;
      double     area; ///< area of the face [m^2]
    };

    RockColumn column_of(const std::vector<Stack> &stacks, const RockParameters &parameters)
    {
      const auto by_length = [](const Stack &a, const Stack &b)
      { return a.line.nodes.size() < b.line.nodes.size(); };
      const InwardLine &longest = std::max_element(stacks.begin(), stacks.end(), by_length)->line;
      RockColumn        column;
      column.nodes = longest.nodes;
      for (std::size_t k = 0; k < longest.nodes.size(); ++k)
      {
        column.z.push_back(longest.places[k][2]);
        if (k == 0)
          continue;
        Rocks rocks;
        for (const Stack &stack : stacks)
          if (const auto &nodes = stack.line.nodes;
              k < nodes.size() && nodes[k - 1] == longest.nodes[k - 1] && nodes[k] == longest.nodes[k])
            rocks.emplace_back(parameters.materials.at(stack.line.cells[k - 1]->material_id()), stack.area);
        column.material.push_back(mean(rocks));
      }
      return column;
    }

    /** Sets the columns: on the lower edges of the side faces, or one anywhere if there are no side faces. */
    void find_columns(const RockGrid &grid, const std::vector<ArtificialFace> &faces,
                      const RockParameters &parameters, RockModel &model)
    {
      std::vector<bool> side(grid.n_nodes(), false);
      bool              has_sides = false;
      for (const ArtificialFace &face : faces)
        if (face.rank() < 2)
          for (const unsigned int corner : face.corners)
            side[grid.node(face.cell, corner)] = has_sides = true;
      std::vector<std::vector<Stack>>      columns;
      std::map<unsigned int, unsigned int> column_at; // lowest node -> column
      for (const ArtificialFace &face : faces)
        if (face.rank() == 2)
          for (const unsigned int corner : face.corners)
          {
            const unsigned int bottom = grid.node(face.cell, corner);
            if (!side[bottom] && (has_sides || (!columns.empty() && !column_at.count(bottom))))
              continue;
            const unsigned int c = column_at.insert({bottom, columns.size()}).first->second;
            columns.resize(std::max<std::size_t>(columns.size(), c + 1));
            columns[c].push_back(
                {inward_line(grid, face, corner, std::numeric_limits<std::size_t>::max()), face.area});
          }
      std::map<unsigned int, RockModel::Place> place;
      for (unsigned int c = 0; c < columns.size(); ++c)
      {
        model.columns.push_back(column_of(columns[c], parameters));
        for (unsigned int k = 0; k < model.columns[c].nodes.size(); ++k)
          place.insert({model.columns[c].nodes[k], {c, k}});
      }
      for (const BoundaryLine &line : model.lines)
      {
        const auto found = place.find(line.nodes[0]);
        model.place.push_back(
            side[line.nodes[0]] && found != place.end() ? found->second : RockModel::Place{no_node, no_node});
      }
    }
  } // namespace

  RockModel make_model_with_rows(const HexMesh &mesh, const RockParameters &parameters,
                                 const std::vector<unsigned int> &master, const ChooseRows &choose)
  {
    const RockGrid                    grid(mesh, parameters, master);
    const std::vector<ArtificialFace> faces = artificial_faces(grid);
    RockModel                         model;
    model.points = grid.points;
    model.node.assign(mesh.nodes.size(), no_node);
    for (unsigned int d = 0; d < grid.mesh_node.size(); ++d)
      model.node[grid.mesh_node[d]] = grid.node_of_dof[d];
    const Corners                  cells = corners_of(grid);
    const std::vector<Integration> kind = integrations(grid, faces, parameters, model);
    model.largest_crossing = largest_crossing(grid, parameters);
    assemble_rock(grid, cells, kind, parameters,
                  choose ? choose(grid, cells, kind, faces) : std::vector<bool>(grid.n_nodes(), true), model);
    sort_cells(grid, cells, kind, parameters, model);
    find_lines(grid, faces, parameters, model);
    find_columns(grid, faces, parameters, model);
    for (const ArtificialFace &face : faces)
    {
      const int    volume = face.cell->material_id();
      BoundaryFace f{{}, face.normal, face.area, volume, parameters.materials.at(volume)};
      for (unsigned int i = 0; i < 4; ++i)
        f.nodes[i] = grid.node(face.cell, face.corners[i]);
      model.faces.push_back(f);
    }
    return model;
  }

  RockModel make_rock_model(const HexMesh &mesh, const RockParameters &parameters,
                            const std::vector<unsigned int> &master)
  {
    return make_model_with_rows(mesh, parameters, master, {});
  }

  RockOperator make_operator(const RockModel &model, const NodalKernel kernel)
  {
    return {model.stiffness, model.points, model.nodal_cells, model.in_other_cell, kernel};
  }

  RockOperator make_operator(const RockModel &model, RockSplit &split)
  {
    std::vector<std::vector<unsigned int>> lines;
    for (const BoundaryLine &line : model.lines)
      lines.push_back(line.nodes);
    split.set_lines(std::move(lines));
    return {model.stiffness, model.points, model.nodal_cells, model.in_other_cell, nodal_kernel(), split};
  }
} // namespace Voussoir
