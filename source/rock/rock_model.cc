#include <voussoir/base/error.h>
#include <voussoir/rock/rock_model.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace Voussoir
{
  namespace
  {
    /** Corners of the unit cube in the order of a cell's nodes, and the three corners beside each. */
    constexpr int          cube[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                         {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    constexpr unsigned int beside[8][3] = {{1, 3, 4}, {0, 2, 5}, {3, 1, 6}, {2, 0, 7},
                                           {5, 7, 0}, {4, 6, 1}, {7, 5, 2}, {6, 4, 3}};
    constexpr unsigned int opposite[8] = {6, 7, 4, 5, 2, 3, 0, 1};

    Vector3 difference(const Vector3 &a, const Vector3 &b)
    {
      return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
    }

    double length(const Vector3 &a)
    {
      return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    }

    /** Gradients of the eight shape functions at a point of the unit cube [1/m]; returns det J [m^3]. */
    double gradients(const HexMesh &mesh, const HexMesh::Cell &cell, const Vector3 &xi,
                     std::array<Vector3, 8> &gradient)
    {
      Matrix3                jacobian{};
      std::array<Vector3, 8> reference;
      for (unsigned int v = 0; v < 8; ++v)
        for (unsigned int a = 0; a < 3; ++a)
        {
          double derivative = 2. * cube[v][a] - 1.;
          for (unsigned int b = 0; b < 3; ++b)
            if (b != a)
              derivative *= cube[v][b] ? xi[b] : 1. - xi[b];
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

    /** What is needed of the mesh's topology. */
    struct Grid
    {
      const HexMesh                         &mesh;
      std::vector<bool>                      in_region;     ///< of each cell
      std::vector<std::vector<unsigned int>> cells_of_node; ///< of the region

      Grid(const HexMesh &mesh, const RockParameters &parameters)
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

      unsigned int corner(const unsigned int cell, const unsigned int node) const
      {
        const auto &nodes = mesh.cells[cell].nodes;
        return std::find(nodes.begin(), nodes.end(), node) - nodes.begin();
      }

      bool share_a_cell(const unsigned int a, const unsigned int b) const
      {
        for (const unsigned int k : cells_of_node[a])
          if (corner(k, b) < 8)
            return true;
        return false;
      }

      /** The node after @p b on the grid line that comes from @p a; no_node at its end. */
      unsigned int next(const unsigned int a, const unsigned int b) const
      {
        unsigned int found = no_node;
        for (const unsigned int k : cells_of_node[b])
          for (const unsigned int v : beside[corner(k, b)])
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

      /** The grid line from @p a over @p b to its end, or @p n nodes of it. */
      std::vector<unsigned int> line(const unsigned int a, const unsigned int b, const std::size_t n) const
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
    };

    /** A face of the artificial boundary, by mesh nodes, with its cell. */
    struct Face
    {
      std::array<unsigned int, 4> nodes;
      unsigned int                cell;
      Vector3                     normal; ///< outward
      double                      area;

      unsigned int rank() const ///< in the order in which lines are chosen
      {
        return std::abs(normal[2]) > .7 ? 2 : std::abs(normal[1]) > .7 ? 1 : 0;
      }
    };

    std::vector<Face> artificial_faces(const Grid &grid)
    {
      const HexMesh    &mesh = grid.mesh;
      const FaceTable   table(mesh);
      std::vector<Face> faces;
      for (const HexMesh::Face &face : mesh.faces)
        if (face.surface == PhysicalId::artificial)
        {
          const auto owners = table.owners(face.nodes);
          for (const auto *owner : {owners.first, owners.second})
            if (owner != nullptr && grid.in_region[owner->cell])
            {
              Face f;
              f.cell = owner->cell;
              for (unsigned int i = 0; i < 4; ++i)
                f.nodes[i] = mesh.cells[f.cell].nodes[hex_faces[owner->cell_face][i]];
              const Vector3 p = difference(mesh.nodes[f.nodes[2]], mesh.nodes[f.nodes[0]]),
                            q = difference(mesh.nodes[f.nodes[3]], mesh.nodes[f.nodes[1]]);
              f.normal = {{p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]}};
              const double norm = length(f.normal);
              for (double &x : f.normal)
                x /= norm;
              f.area = .5 * norm;
              faces.push_back(f);
            }
        }
      std::stable_sort(faces.begin(), faces.end(),
                       [](const Face &a, const Face &b) { return a.rank() < b.rank(); });
      return faces;
    }

    /** Number of layers between each cell and the artificial boundary, 1 at the boundary. */
    std::vector<unsigned int> layers(const Grid &grid, const std::vector<Face> &faces)
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
      for (const Face &face : faces)
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

    void number_nodes(const Grid &grid, const std::vector<unsigned int> &master, RockModel &model)
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

    Corners corners_of_nodes(const Grid &grid, const RockModel &model)
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
            if (!nodal[corner.first] || v != opposite[corner.second])
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
          xi[d] = gauss[cube[q][d]];
        double shape = 1.;
        for (unsigned int d = 0; d < 3; ++d)
          shape *= cube[v][d] ? xi[d] : 1. - xi[d];
        double jacobian = gradients(mesh, cell, xi, gradient);
        model.mass[row] += material.density * shape * jacobian / 8.;
        if (nodal)
        {
          if (q != v && std::find(beside[q], beside[q] + 3, v) == beside[q] + 3)
            continue; // the gradient vanishes there
          for (unsigned int d = 0; d < 3; ++d)
            xi[d] = cube[q][d];
          jacobian = gradients(mesh, cell, xi, gradient);
        }
        const double   weight = jacobian / 8.;
        const Vector3 &g = gradient[v];
        for (unsigned int w = 0; w < 8; ++w)
        {
          const Vector3 &h = gradient[w];
          const double   gh = mu * (g[0] * h[0] + g[1] * h[1] + g[2] * h[2]);
          if (nodal && w == opposite[v])
            continue;
          Matrix3 block;
          for (unsigned int a = 0; a < 3; ++a)
            for (unsigned int b = 0; b < 3; ++b)
              block[3 * a + b] = weight * (lambda * g[a] * h[b] + mu * g[b] * h[a] + (a == b ? gh : 0.));
          model.stiffness.add(row, model.node[cell.nodes[w]], block);
        }
      }
    }

    void assemble(const Grid &grid, const RockParameters &parameters, RockModel &model)
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

    /** The node of the cell behind @p face that is joined to @p node. */
    unsigned int behind(const Grid &grid, const Face &face, const unsigned int node)
    {
      const auto &nodes = grid.mesh.cells[face.cell].nodes;
      for (const unsigned int v : beside[grid.corner(face.cell, node)])
        if (std::find(face.nodes.begin(), face.nodes.end(), nodes[v]) == face.nodes.end())
          return nodes[v];
      return no_node;
    }

    void find_lines(const Grid &grid, const std::vector<Face> &faces, const RockParameters &parameters,
                    RockModel &model)
    {
      const HexMesh         &mesh = grid.mesh;
      std::set<unsigned int> done;
      constexpr std::size_t  longest = 9; // nodes, for order 4
      for (const Face &face : faces)
        for (const unsigned int node : face.nodes)
          if (done.insert(model.node[node]).second)
          {
            BoundaryLine line;
            double       along = 0.;
            unsigned int last = node;
            for (const unsigned int i : grid.line(node, behind(grid, face, node), longest))
            {
              along += length(difference(mesh.nodes[i], mesh.nodes[last]));
              line.nodes.push_back(model.node[i]);
              line.position.push_back(along);
              last = i;
            }
            const Material &material = parameters.materials.at(mesh.cells[face.cell].volume);
            line.c_p = p_wave_speed(material);
            line.c_s = s_wave_speed(material);
            line.distance = length(difference(mesh.nodes[node], parameters.centre));
            model.lines.push_back(line);
          }
    }

    /** The vertical grid line that begins behind a face of the bottom. */
    RockColumn column_above(const Grid &grid, const Face &face, const unsigned int foot,
                            const RockParameters &parameters, const RockModel &model)
    {
      RockColumn   column;
      unsigned int last = no_node;
      for (const unsigned int i :
           grid.line(foot, behind(grid, face, foot), std::numeric_limits<std::size_t>::max()))
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
    void find_columns(const Grid &grid, const std::vector<Face> &faces, const RockParameters &parameters,
                      RockModel &model)
    {
      std::set<unsigned int> side, done;
      for (const Face &face : faces)
        if (face.rank() < 2)
          for (const unsigned int node : face.nodes)
            side.insert(model.node[node]);
      for (const Face &face : faces)
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

  double p_wave_speed(const Material &m)
  {
    return std::sqrt(m.young * (1. - m.poisson) / ((1. + m.poisson) * (1. - 2. * m.poisson) * m.density));
  }

  double s_wave_speed(const Material &m)
  {
    return std::sqrt(m.young / (2. * (1. + m.poisson) * m.density));
  }

  RockModel make_rock_model(const HexMesh &mesh, const RockParameters &parameters,
                            const std::vector<unsigned int> &master)
  {
    const Grid              grid(mesh, parameters);
    const std::vector<Face> faces = artificial_faces(grid);
    RockModel               model;
    number_nodes(grid, master, model);
    model.layer = layers(grid, faces);
    assemble(grid, parameters, model);
    find_lines(grid, faces, parameters, model);
    find_columns(grid, faces, parameters, model);
    for (const Face &face : faces)
    {
      BoundaryFace f{{}, face.normal, face.area, parameters.materials.at(mesh.cells[face.cell].volume)};
      for (unsigned int i = 0; i < 4; ++i)
        f.nodes[i] = model.node[face.nodes[i]];
      model.faces.push_back(f);
    }
    return model;
  }

  std::vector<unsigned int> tie_layer(const HexMesh &mesh, const unsigned int direction)
  {
    std::vector<unsigned int> master(mesh.nodes.size());
    for (unsigned int i = 0; i < master.size(); ++i)
      master[i] = i;
    for (const HexMesh::Cell &cell : mesh.cells)
      for (unsigned int v = 0; v < 8; ++v)
        for (const unsigned int w : beside[v])
        {
          // The edge that is most nearly along the direction joins the two copies.
          const unsigned int a = cell.nodes[v], b = cell.nodes[w];
          const Vector3      d = difference(mesh.nodes[b], mesh.nodes[a]);
          if (std::abs(d[direction]) > .99 * length(d))
            master[a] = master[b] = std::min(a, b);
        }
    return master;
  }

  HexMesh extruded_section(const HexMesh &mesh, const RockParameters &parameters,
                           const unsigned int direction, const int sense)
  {
    const Grid              grid(mesh, parameters);
    const std::vector<Face> all = artificial_faces(grid);
    std::vector<Face>       cut;
    double                  thickness = 0.;
    for (const Face &face : all)
      if (sense * face.normal[direction] > .7)
      {
        cut.push_back(face);
        thickness = std::max(thickness, std::sqrt(face.area));
      }

    HexMesh                              section;
    std::map<unsigned int, unsigned int> copy; // mesh node -> its place in the section, in pairs
    for (const Face &face : cut)
      for (const unsigned int node : face.nodes)
        if (copy.try_emplace(node, section.nodes.size()).second)
        {
          section.nodes.push_back(mesh.nodes[node]);
          section.nodes.push_back(mesh.nodes[node]);
          section.nodes.back()[direction] -= sense * thickness;
        }
    for (const Face &face : cut) // seen from outside, the corners are counter-clockwise
    {
      HexMesh::Cell cell;
      for (unsigned int i = 0; i < 4; ++i)
      {
        cell.nodes[i] = copy[face.nodes[i]] + 1;
        cell.nodes[i + 4] = copy[face.nodes[i]];
      }
      cell.volume = mesh.cells[face.cell].volume;
      section.cells.push_back(cell);
    }
    // Edges of the cut that other artificial faces share.
    std::set<std::pair<unsigned int, unsigned int>> edges;
    for (const Face &face : all)
      if (sense * face.normal[direction] <= .7)
        for (unsigned int i = 0; i < 4; ++i)
          edges.insert(std::minmax(face.nodes[i], face.nodes[(i + 1) % 4]));
    for (const Face &face : cut)
      for (unsigned int i = 0; i < 4; ++i)
      {
        const unsigned int a = face.nodes[i], b = face.nodes[(i + 1) % 4];
        if (edges.count(std::minmax(a, b)))
          section.faces.push_back({{copy[a], copy[b], copy[b] + 1, copy[a] + 1}, PhysicalId::artificial});
      }
    return section;
  }

  std::vector<Dashpot> viscous_boundary(const RockModel &model, const std::array<double, 3> &centre,
                                        const double normal_spring, const double tangential_spring)
  {
    std::map<unsigned int, Dashpot> dashpots;
    for (const BoundaryFace &face : model.faces)
    {
      const Material &m = face.material;
      const double    c_p = p_wave_speed(m), c_s = s_wave_speed(m), shear = m.density * c_s * c_s;
      for (const unsigned int node : face.nodes)
      {
        Dashpot     &dashpot = dashpots.try_emplace(node, Dashpot{node, Matrix3{}, Matrix3{}}).first->second;
        const double r = length(difference(model.points[node], centre));
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; b < 3; ++b)
          {
            const double normal = face.normal[a] * face.normal[b], tangential = (a == b ? 1. : 0.) - normal;
            dashpot.damping[3 * a + b] += m.density * (c_p * normal + c_s * tangential) * face.area / 4.;
            dashpot.stiffness[3 * a + b] +=
                shear / r * (normal_spring * normal + tangential_spring * tangential) * face.area / 4.;
          }
      }
    }
    std::vector<Dashpot> result;
    for (const auto &entry : dashpots)
      result.push_back(entry.second);
    return result;
  }
} // namespace Voussoir
