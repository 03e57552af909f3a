#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_tools.h>

#include <voussoir/error.h>
#include <voussoir/mesh_joints.h>
#include <voussoir/solid_model.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <sstream>

namespace Voussoir
{
  using namespace dealii;

  SolidModel::SolidModel(const HexMesh &mesh, const unsigned int degree) : fe(degree), dof_handler(triangulation)
  {
    std::vector<Point<3>> vertices;
    for (const auto &x : mesh.nodes)
      vertices.emplace_back(x[0], x[1], x[2]);
    constexpr unsigned int   lexicographic[8] = {0, 1, 3, 2, 4, 5, 7, 6};
    std::vector<CellData<3>> cells(mesh.cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i)
      {
        cells[i].material_id = mesh.cells[i].volume;
        for (unsigned int v = 0; v < 8; ++v)
          cells[i].vertices[lexicographic[v]] = mesh.cells[i].nodes[v];
      }
    GridTools::consistently_order_cells(cells);
    triangulation.create_triangulation(vertices, cells, SubCellData());

    std::map<std::array<unsigned int, 4>, int> surface_of;
    for (const HexMesh::Face &face : mesh.faces)
      {
        auto key = face.nodes;
        std::sort(key.begin(), key.end());
        surface_of[key] = face.surface;
      }
    std::set<int> numbers;
    for (const auto &cell : triangulation.active_cell_iterators())
      {
        numbers.insert(cell->material_id());
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
            {
              std::array<unsigned int, 4> key;
              for (unsigned int v = 0; v < 4; ++v)
                key[v] = cell->face(f)->vertex_index(v);
              std::sort(key.begin(), key.end());
              const auto found = surface_of.find(key);
              cell->face(f)->set_boundary_id(found == surface_of.end() ? 0 : found->second);
            }
      }
    body_numbers.assign(numbers.begin(), numbers.end());

    dof_handler.distribute_dofs(fe);
    const auto support = [&] {
      std::vector<Point<3>> p(dof_handler.n_dofs());
      DoFTools::map_dofs_to_support_points(MappingQ1<3>(), dof_handler, p);
      return p;
    };
    points = support();
    body.resize(points.size());
    surfaces.resize(points.size());
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell()), face_dofs(fe.n_dofs_per_face());
    for (const auto &cell : dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        const unsigned int b =
          std::lower_bound(body_numbers.begin(), body_numbers.end(), static_cast<int>(cell->material_id())) -
          body_numbers.begin();
        for (const auto d : dofs)
          body[d] = b;
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() != 0)
            {
              cell->face(f)->get_dof_indices(face_dofs);
              for (const auto d : face_dofs)
                surfaces[d].insert(cell->face(f)->boundary_id());
            }
      }
    std::vector<bool>         fixed(points.size());
    std::vector<unsigned int> master(points.size());
    std::iota(master.begin(), master.end(), 0);
    for (unsigned int i = 0; i < points.size(); ++i)
      fixed[i] = on_surface(i, PhysicalId::base);
    number_equations(fixed, master);
  }

  void SolidModel::number_equations(const std::vector<bool> &fixed, const std::vector<unsigned int> &master)
  {
    equation.assign(n_nodes(), rigid_ground);
    first_equation.assign(1, 0);
    unsigned int next = 0;
    for (unsigned int b = 0; b < n_bodies(); ++b)
      {
        for (unsigned int i = 0; i < n_nodes(); ++i)
          if (body[i] == b && master[i] == i && !fixed[i])
            equation[i] = next++;
        first_equation.push_back(next);
      }
    for (unsigned int i = 0; i < n_nodes(); ++i)
      equation[i] = equation[master[i]];
  }

  namespace
  {
    /** Stiffness of a cell, node by node, with the incompatible modes condensed out. */
    class CellStiffness
    {
    public:
      CellStiffness(const FiniteElement<3> &fe, const bool incompatible_modes)
        : fe(fe), modes(incompatible_modes && fe.degree == 1),
          values(fe, QGauss<3>(fe.degree + 1),
                 update_values | update_gradients | update_JxW_values | update_inverse_jacobians | update_jacobians |
                   update_quadrature_points),
          centre(fe, QMidpoint<3>(), update_inverse_jacobians | update_jacobians)
      {}

      /** blocks: n x n; mass: n, row sums. */
      void reinit(const DoFHandler<3>::active_cell_iterator &cell, const Material &material)
      {
        const double e = material.young, nu = material.poisson, density = material.density,
                     lambda = e * nu / ((1 + nu) * (1 - 2 * nu)), mu = e / (2 * (1 + nu));
        values.reinit(cell);
        if (modes)
          centre.reinit(cell);
        const unsigned int n = fe.n_dofs_per_cell(), n_all = n + (modes ? 3 : 0);
        blocks.assign(n_all * n_all, Matrix3{});
        mass.assign(n, 0.);
        std::vector<Tensor<1, 3>> gradient(n_all);
        for (const unsigned int q : values.quadrature_point_indices())
          {
            const double JxW = values.JxW(q);
            for (unsigned int i = 0; i < n; ++i)
              {
                gradient[i] = values.shape_grad(i, q);
                mass[i] += density * values.shape_value(i, q) * JxW;
              }
            if (modes)
              for (unsigned int m = 0; m < 3; ++m)
                {
                  // mode 1 - xi_m^2, xi in [-1,1]; its gradient with the Jacobian of the centre, times j_0 / j
                  const double  x = values.get_quadrature().point(q)[m];
                  const double  scale = centre.jacobian(0).determinant() / values.jacobian(q).determinant();
                  Tensor<1, 3>  g;
                  for (unsigned int d = 0; d < 3; ++d)
                    g[d] = -4. * (2. * x - 1.) * centre.inverse_jacobian(0)[m][d] * scale;
                  gradient[n + m] = g;
                }
            for (unsigned int i = 0; i < n_all; ++i)
              for (unsigned int j = 0; j <= i; ++j)
                {
                  const Tensor<1, 3> &g = gradient[i], &h = gradient[j];
                  const double        gh = mu * (g * h);
                  for (unsigned int a = 0; a < 3; ++a)
                    for (unsigned int b = 0; b < 3; ++b)
                      blocks[i * n_all + j][3 * a + b] +=
                        JxW * (lambda * g[a] * h[b] + mu * g[b] * h[a] + (a == b ? gh : 0.));
                }
          }
        for (unsigned int i = 0; i < n_all; ++i)
          for (unsigned int j = i + 1; j < n_all; ++j)
            for (unsigned int a = 0; a < 3; ++a)
              for (unsigned int b = 0; b < 3; ++b)
                blocks[i * n_all + j][3 * a + b] = blocks[j * n_all + i][3 * b + a];
        if (modes)
          condense(n);
      }

      std::vector<Matrix3> blocks;
      std::vector<double>  mass;

    private:
      void condense(const unsigned int n)
      {
        const unsigned int n_all = n + 3;
        FullMatrix<double> K_aa(9, 9), K_au(9, 3 * n), X(9, 3 * n);
        for (unsigned int i = 0; i < 9; ++i)
          {
            for (unsigned int j = 0; j < 9; ++j)
              K_aa(i, j) = blocks[(n + i / 3) * n_all + n + j / 3][3 * (i % 3) + j % 3];
            for (unsigned int j = 0; j < 3 * n; ++j)
              K_au(i, j) = blocks[(n + i / 3) * n_all + j / 3][3 * (i % 3) + j % 3];
          }
        K_aa.gauss_jordan();
        K_aa.mmult(X, K_au);
        std::vector<Matrix3> condensed(n * n);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            for (unsigned int a = 0; a < 3; ++a)
              for (unsigned int b = 0; b < 3; ++b)
                {
                  double x = blocks[i * n_all + j][3 * a + b];
                  for (unsigned int k = 0; k < 9; ++k)
                    x -= K_au(k, 3 * i + a) * X(k, 3 * j + b);
                  condensed[i * n + j][3 * a + b] = x;
                }
        blocks.swap(condensed);
      }

      const FiniteElement<3> &fe;
      const bool              modes;
      FEValues<3>             values, centre;
    };
  } // namespace

  Structure assemble_structure(const SolidModel &model, const std::vector<Material> &materials,
                               const bool incompatible_modes)
  {
    Structure structure;
    structure.mass.assign(model.first_equation.back(), Matrix3{});
    structure.added_mass.assign(model.first_equation.back(), Matrix3{});
    std::vector<std::vector<std::vector<unsigned int>>> columns(model.n_bodies());
    for (unsigned int b = 0; b < model.n_bodies(); ++b)
      columns[b].resize(model.first_equation[b + 1] - model.first_equation[b]);

    std::vector<types::global_dof_index> dofs(model.fe.n_dofs_per_cell());
    for (const auto &cell : model.dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        const unsigned int b = model.body[dofs[0]], first = model.first_equation[b];
        for (const auto i : dofs)
          for (const auto j : dofs)
            if (model.equation[i] != rigid_ground && model.equation[j] != rigid_ground)
              columns[b][model.equation[i] - first].push_back(model.equation[j] - first);
      }
    for (unsigned int b = 0; b < model.n_bodies(); ++b)
      {
        for (auto &row : columns[b])
          {
            std::sort(row.begin(), row.end());
            row.erase(std::unique(row.begin(), row.end()), row.end());
          }
        Body body;
        body.number     = model.body_numbers[b];
        body.first_node = model.first_equation[b];
        body.stiffness  = BlockSparseMatrix(columns[b]);
        structure.bodies.push_back(std::move(body));
      }

    CellStiffness stiffness(model.fe, incompatible_modes);
    for (const auto &cell : model.dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        const unsigned int b = model.body[dofs[0]];
        stiffness.reinit(cell, materials[materials.size() == 1 ? 0 : b]);
        Body &body = structure.bodies[b];
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (const unsigned int e = model.equation[dofs[i]]; e != rigid_ground)
            {
              for (unsigned int c = 0; c < 3; ++c)
                structure.mass[e][4 * c] += stiffness.mass[i];
              for (unsigned int j = 0; j < dofs.size(); ++j)
                if (model.equation[dofs[j]] != rigid_ground)
                  body.stiffness.add(e - body.first_node, model.equation[dofs[j]] - body.first_node,
                                     stiffness.blocks[i * dofs.size() + j]);
            }
      }
    for (Body &body : structure.bodies)
      body.stiffness.symmetrise();
    for (std::size_t i = 0; i < structure.mass.size(); ++i)
      if (!(structure.mass[i][0] > 0.))
        throw InputError("An element of the mesh is so distorted that a node of it has no positive mass. Improve the "
                         "shape of the elements, or use degree 1.");
    return structure;
  }

  std::vector<Pair> find_pairs(const SolidModel &model, const unsigned int n_joints)
  {
    // Area vectors of the nodes of each side 1: outward from side 1, that is from side 1 to side 2.
    std::vector<std::map<unsigned int, Tensor<1, 3>>>   side_1(n_joints);
    std::vector<std::set<unsigned int>>                 side_2(n_joints);
    FEFaceValues<3>                                     values(model.fe, QGauss<2>(model.fe.degree + 1),
                           update_values | update_normal_vectors | update_JxW_values);
    std::vector<types::global_dof_index>                dofs(model.fe.n_dofs_per_cell());
    for (const auto &cell : model.dof_handler.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary() && is_joint_side(cell->face(f)->boundary_id()))
          {
            const bool         is_side_2 = cell->face(f)->boundary_id() > PhysicalId::joint_side_2;
            const unsigned int joint =
              cell->face(f)->boundary_id() - (is_side_2 ? PhysicalId::joint_side_2 : PhysicalId::joint_side_1) - 1;
            AssertThrow(joint < n_joints, ExcInternalError());
            cell->get_dof_indices(dofs);
            values.reinit(cell, f);
            for (unsigned int i = 0; i < dofs.size(); ++i)
              if (model.fe.has_support_on_face(i, f))
                {
                  if (is_side_2)
                    side_2[joint].insert(dofs[i]);
                  else
                    for (const unsigned int q : values.quadrature_point_indices())
                      side_1[joint][dofs[i]] += values.shape_value(i, q) * values.JxW(q) * values.normal_vector(q);
                }
          }

    std::vector<Pair> pairs;
    for (unsigned int j = 0; j < n_joints; ++j)
      {
        std::set<unsigned int> free = side_2[j];
        for (const auto &node : side_1[j])
          {
            const Point<3> &p = model.points[node.first];
            double          distance = 1e300;
            unsigned int    nearest  = rigid_ground;
            for (const unsigned int k : free)
              if (const double d = p.distance(model.points[k]); d < distance)
                {
                  distance = d;
                  nearest  = k;
                }
            if (!(distance <= 1e-3 * std::sqrt(node.second.norm())))
              {
                std::ostringstream message;
                message << "Joint " << j + 1 << " of the mesh: the node at (" << p << ") m on side 1 has no partner on side 2";
                if (nearest != rigid_ground)
                  message << "; the nearest is " << distance << " m away";
                message << ". The nodes on the two sides of a joint must coincide: mesh both monoliths with the same divisions.";
                throw InputError(message.str());
              }
            free.erase(nearest);
            Pair pair;
            pair.node_1 = model.equation[node.first];
            pair.node_2 = model.equation[nearest];
            if (pair.node_1 == rigid_ground && pair.node_2 == rigid_ground)
              continue;
            const auto same = std::find_if(pairs.begin(), pairs.end(), [&](const Pair &other) {
              return other.joint == j && other.node_1 == pair.node_1 && other.node_2 == pair.node_2;
            });
            if (same != pairs.end()) // nodes that move as one
              {
                same->area += node.second.norm();
                continue;
              }
            pair.joint = j;
            pair.area  = node.second.norm();
            for (unsigned int d = 0; d < 3; ++d)
              pair.place[d] = p[d];
            const Tensor<1, 3> n = node.second / node.second.norm();
            Tensor<1, 3>       up;
            up[std::abs(n[2]) < .9 ? 2 : 1] = 1.;
            Tensor<1, 3> b = up - (up * n) * n;
            b /= b.norm();
            const Tensor<1, 3> a = cross_product_3d(b, n);
            for (unsigned int d = 0; d < 3; ++d)
              pair.frame[0][d] = n[d], pair.frame[1][d] = a[d], pair.frame[2][d] = b[d];
            pairs.push_back(pair);
          }
      }
    return pairs;
  }
} // namespace Voussoir
