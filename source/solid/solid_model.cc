// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>

#include <voussoir/base/error.h>
#include <voussoir/mesh/mesh_joints.h>
#include <voussoir/solid/cell_elasticity.h>
#include <voussoir/solid/solid_model.h>
#include <voussoir/solid/triangulation.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <sstream>

namespace Voussoir
{
  using namespace dealii;

  SolidModel::SolidModel(const HexMesh &mesh, const unsigned int degree)
      : fe(degree), dof_handler(triangulation), n_zones(mesh.zones.size())
  {
    std::vector<unsigned int> all(mesh.cells.size());
    std::iota(all.begin(), all.end(), 0);
    make_triangulation(mesh, all, triangulation);
    for (const HexMesh::Cell &cell : mesh.cells)
      zone.push_back(cell.zone); // deal.II keeps the order of the cells
    std::set<int> numbers;
    for (const auto &cell : triangulation.active_cell_iterators())
      numbers.insert(cell->material_id());
    body_numbers.assign(numbers.begin(), numbers.end());

    dof_handler.distribute_dofs(fe);
    const auto support = [&]
    {
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

  void SolidModel::free_base()
  {
    base_is_fixed = false;
    std::vector<unsigned int> master(n_nodes());
    std::iota(master.begin(), master.end(), 0);
    number_equations(std::vector<bool>(n_nodes(), false), master);
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

  const Material &SolidModel::material_of(const DoFHandler<3>::active_cell_iterator &cell,
                                          const std::vector<Material>               &materials) const
  {
    if (materials.size() == 1)
      return materials[0];
    AssertThrow(materials.size() == n_zones, ExcDimensionMismatch(materials.size(), n_zones));
    return materials[zone[cell->active_cell_index()]];
  }

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
      body.number = model.body_numbers[b];
      body.first_node = model.first_equation[b];
      body.stiffness = BlockSparseMatrix(columns[b]);
      structure.bodies.push_back(std::move(body));
    }

    CellElasticity stiffness(model.fe, incompatible_modes);
    for (const auto &cell : model.dof_handler.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      const unsigned int b = model.body[dofs[0]];
      stiffness.reinit(cell, model.material_of(cell, materials));
      Body &body = structure.bodies[b];
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (const unsigned int e = model.equation[dofs[i]]; e != rigid_ground)
        {
          for (unsigned int c = 0; c < 3; ++c)
            structure.mass[e][4 * c] += stiffness.mass[i];
          for (unsigned int j = 0; j < dofs.size(); ++j)
            if (model.equation[dofs[j]] != rigid_ground)
              body.stiffness.add(e - body.first_node, model.equation[dofs[j]] - body.first_node,
                                 stiffness.stiffness[i * dofs.size() + j]);
        }
    }
    for (Body &body : structure.bodies)
      body.stiffness.symmetrise();
    for (std::size_t i = 0; i < structure.mass.size(); ++i)
      if (!(structure.mass[i][0] > 0.))
        throw InputError(
            "An element of the mesh is so distorted that a node of it has no positive mass. Improve the "
            "shape of the elements, or use degree 1.");
    return structure;
  }

  namespace
  {
    /** Two coincident nodes of a joint, and the tributary area vector, from side 1 to side 2. */
    struct NodePair
    {
      unsigned int              joint, node_1, node_2;
      Tensor<1, 3>              area;
      std::vector<Tensor<1, 3>> planes; ///< its parts, where faces meet at an edge; else empty
    };

    /** Adds the area vector of a face to the plane that it lies in, within 20 degrees. */
    void add_to_planes(std::vector<Tensor<1, 3>> &planes, const Tensor<1, 3> &area)
    {
      for (Tensor<1, 3> &plane : planes)
        if (plane * area > std::cos(20. * numbers::PI / 180.) * plane.norm() * area.norm())
        {
          plane += area;
          return;
        }
      planes.push_back(area);
    }

    std::array<Vector3, 3> frame_of(const Tensor<1, 3> &area)
    {
      const Tensor<1, 3> n = area / area.norm();
      Tensor<1, 3>       up;
      up[std::abs(n[2]) < .9 ? 2 : 1] = 1.;
      Tensor<1, 3> b = up - (up * n) * n;
      b /= b.norm();
      const Tensor<1, 3>     a = cross_product_3d(b, n);
      std::array<Vector3, 3> frame;
      for (unsigned int d = 0; d < 3; ++d)
        frame[0][d] = n[d], frame[1][d] = a[d], frame[2][d] = b[d];
      return frame;
    }

    std::vector<NodePair> match_joint_nodes(const SolidModel &model, const unsigned int n_joints)
    {
      // Area vectors of the nodes of each side 1: outward from side 1, that is from side 1 to side 2.
      std::vector<std::map<unsigned int, Tensor<1, 3>>>              side_1(n_joints);
      std::vector<std::map<unsigned int, std::vector<Tensor<1, 3>>>> planes(n_joints);
      std::vector<std::set<unsigned int>>                            side_2(n_joints);
      FEFaceValues<3>                      values(model.fe, QGauss<2>(model.fe.degree + 1),
                                                  update_values | update_normal_vectors | update_JxW_values);
      std::vector<types::global_dof_index> dofs(model.fe.n_dofs_per_cell());
      for (const auto &cell : model.dof_handler.active_cell_iterators())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary() && is_joint_side(cell->face(f)->boundary_id()))
          {
            const bool         is_side_2 = cell->face(f)->boundary_id() > PhysicalId::joint_side_2;
            const unsigned int joint = cell->face(f)->boundary_id() -
                                       (is_side_2 ? PhysicalId::joint_side_2 : PhysicalId::joint_side_1) - 1;
            AssertThrow(joint < n_joints, ExcInternalError());
            cell->get_dof_indices(dofs);
            values.reinit(cell, f);
            for (unsigned int i = 0; i < dofs.size(); ++i)
              if (model.fe.has_support_on_face(i, f))
              {
                if (is_side_2)
                  side_2[joint].insert(dofs[i]);
                else
                {
                  Tensor<1, 3> of_face;
                  for (const unsigned int q : values.quadrature_point_indices())
                  {
                    const Tensor<1, 3> part =
                        values.shape_value(i, q) * values.JxW(q) * values.normal_vector(q);
                    side_1[joint][dofs[i]] += part;
                    of_face += part;
                  }
                  add_to_planes(planes[joint][dofs[i]], of_face);
                }
              }
          }

      std::vector<NodePair> matched;
      for (unsigned int j = 0; j < n_joints; ++j)
      {
        std::set<unsigned int> free = side_2[j];
        Tensor<1, 3>           mean;
        for (const auto &node : side_1[j])
          mean += node.second;
        for (const auto &node : side_1[j])
        {
          const Point<3> &p = model.points[node.first];
          double          distance = 1e300;
          unsigned int    nearest = rigid_ground;
          for (const unsigned int k : free)
            if (const double d = p.distance(model.points[k]); d < distance)
            {
              distance = d;
              nearest = k;
            }
          if (!(distance <= 1e-3 * std::sqrt(node.second.norm())))
          {
            std::ostringstream message;
            message << "Joint " << j + 1 << " of the mesh: the node at (" << p
                    << ") m on side 1 has no partner on side 2";
            if (nearest != rigid_ground)
              message << "; the nearest is " << distance << " m away";
            message << ". The nodes on the two sides of a joint must coincide: mesh both monoliths with the "
                       "same divisions.";
            throw InputError(message.str());
          }
          free.erase(nearest);
          std::vector<Tensor<1, 3>> &parts = planes[j][node.first];
          std::stable_sort(parts.begin(), parts.end(),
                           [&](const Tensor<1, 3> &x, const Tensor<1, 3> &y)
                           { return x * mean / x.norm() > y * mean / y.norm() + 1e-9 * mean.norm(); });
          matched.push_back(
              {j, node.first, nearest, node.second, parts.size() > 1 ? parts : std::vector<Tensor<1, 3>>()});
        }
      }
      return matched;
    }
  } // namespace

  std::vector<Pair> find_pairs(const SolidModel &model, const unsigned int n_joints)
  {
    std::vector<Pair> pairs;
    for (const NodePair &match : match_joint_nodes(model, n_joints))
    {
      Pair pair;
      pair.node_1 = model.equation[match.node_1];
      pair.node_2 = model.equation[match.node_2];
      if (pair.node_1 == pair.node_2) // both fixed, or tied
        continue;
      const auto same = std::find_if(pairs.begin(), pairs.end(),
                                     [&](const Pair &other) {
                                       return other.joint == match.joint && other.node_1 == pair.node_1 &&
                                              other.node_2 == pair.node_2;
                                     });
      if (same != pairs.end()) // nodes that move as one
      {
        same->area += match.area.norm();
        continue;
      }
      pair.joint = match.joint;
      pair.area = match.area.norm();
      for (unsigned int d = 0; d < 3; ++d)
        pair.place[d] = model.points[match.node_1][d];
      pair.frame = frame_of(match.planes.empty() ? match.area : match.planes[0]);
      if (!match.planes.empty())
        pair.area = 0.;
      for (const Tensor<1, 3> &plane : match.planes)
      {
        const std::array<Vector3, 3> axes = frame_of(plane);
        Matrix3                      in_frame;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int k = 0; k < 3; ++k)
            in_frame[3 * i + k] =
                axes[i][0] * pair.frame[k][0] + axes[i][1] * pair.frame[k][1] + axes[i][2] * pair.frame[k][2];
        pair.planes.push_back(pair.planes.empty() ? Matrix3{{1., 0., 0., 0., 1., 0., 0., 0., 1.}} : in_frame);
        pair.area += plane.norm();
      }
      pairs.push_back(pair);
    }
    return pairs;
  }

  void SolidModel::tie_joints(const unsigned int n_joints, const bool feet_only)
  {
    std::vector<unsigned int> master(n_nodes());
    std::iota(master.begin(), master.end(), 0);
    const auto root = [&](unsigned int i)
    {
      while (master[i] != i)
        i = master[i];
      return i;
    };
    for (const NodePair &match : match_joint_nodes(*this, n_joints))
    {
      if (feet_only && !on_surface(match.node_1, PhysicalId::base))
        continue;
      const unsigned int a = root(match.node_1), b = root(match.node_2);
      master[std::max(a, b)] = std::min(a, b);
    }
    std::vector<bool> fixed(n_nodes());
    for (unsigned int i = 0; i < n_nodes(); ++i)
    {
      master[i] = root(i);
      if (on_surface(i, PhysicalId::base)) // of one monolith is enough
        fixed[master[i]] = base_is_fixed;
    }
    std::fill(body.begin(), body.end(), 0);
    body_numbers.resize(1);
    number_equations(fixed, master);
  }
} // namespace Voussoir
