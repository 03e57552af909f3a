// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/exceptions.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/mapping_q1.h>

#include <voussoir/base/error.h>
#include <voussoir/mesh/mesh_joints.h>
#include <voussoir/solid/cell_elasticity.h>
#include <voussoir/solid/solid_grid.h>
#include <voussoir/solid/solid_model.h>
#include <voussoir/solid/triangulation.h>

#include <algorithm>
#include <numeric>

namespace Voussoir
{
  using namespace dealii;

  SolidModel::SolidModel(const HexMesh &mesh, const unsigned int degree)
      : grid(std::make_unique<SolidGrid>(degree)), degree(degree), n_zones(mesh.zones.size())
  {
    std::vector<unsigned int> all(mesh.cells.size());
    std::iota(all.begin(), all.end(), 0);
    make_triangulation(mesh, all, grid->triangulation);
    std::set<int> numbers;
    for (const HexMesh::Cell &cell : mesh.cells)
    {
      zone.push_back(cell.zone); // deal.II keeps the order of the cells
      numbers.insert(cell.volume);
    }
    body_numbers.assign(numbers.begin(), numbers.end());
    for (const Joint &joint : joints_of(mesh))
      if (joint.is_base())
        (joint.block_1 == 0 ? base_joints : on_footings).insert(PhysicalId::joint_side_2 + joint.number);
    find_nodes();
    master.resize(points.size());
    std::iota(master.begin(), master.end(), 0);
    number_equations(on_base());
  }

  SolidModel::SolidModel(SolidModel &&) noexcept = default;
  SolidModel::~SolidModel() = default;

  /** Determines position, body and surfaces of each node. */
  void SolidModel::find_nodes()
  {
    const FE_Q<3>       &fe = grid->fe;
    const DoFHandler<3> &dof_handler = grid->dof_handler;
    grid->dof_handler.distribute_dofs(fe);
    std::vector<Point<3>> support(dof_handler.n_dofs());
    DoFTools::map_dofs_to_support_points(MappingQ1<3>(), dof_handler, support);
    for (const Point<3> &p : support)
      points.push_back({{p[0], p[1], p[2]}});
    body.resize(points.size());
    surfaces.resize(points.size());
    bonded.resize(points.size());
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
          const int id = cell->face(f)->boundary_id();
          cell->face(f)->get_dof_indices(face_dofs);
          for (const auto d : face_dofs)
          {
            surfaces[d].insert(id);
            bonded[d] = bonded[d] || id == PhysicalId::base;
            if (is_on(id, PhysicalId::base))
              surfaces[d].insert(PhysicalId::base);
          }
        }
    }
  }

  std::vector<bool> SolidModel::on_base() const
  {
    std::vector<bool> result(n_nodes());
    for (unsigned int i = 0; i < n_nodes(); ++i)
      result[i] = on_surface(i, PhysicalId::base);
    return result;
  }

  void SolidModel::free_base()
  {
    base_is_fixed = false;
    number_equations(std::vector<bool>(n_nodes(), false));
  }

  void SolidModel::free_base_joints(const std::set<int> &sides)
  {
    std::vector<bool> fixed = bonded;
    open_base = sides;
    for (unsigned int i = 0; i < n_nodes(); ++i)
      for (const int id : surfaces[i])
        if (base_joints.count(id) > 0 && sides.count(id) == 0)
          fixed[i] = true;
    number_equations(fixed);
  }

  void SolidModel::merge(const std::vector<std::pair<unsigned int, unsigned int>> &pairs,
                         const bool                                                all_bodies)
  {
    NumberPairs nodes = pairs, bodies;
    for (unsigned int i = 0; i < n_nodes(); ++i)
      nodes.emplace_back(i, master[i]);
    for (const auto &[i, j] : pairs)
      bodies.emplace_back(body[i], body[j]);
    master = smallest_of_sets(n_nodes(), nodes);
    const std::vector<unsigned int> joined = smallest_of_sets(n_bodies(), bodies);
    std::vector<int>                numbers;
    std::vector<unsigned int>       number(n_bodies(), 0);
    for (unsigned int b = 0; b < n_bodies(); ++b)
      if (const unsigned int first = all_bodies ? 0 : joined[b]; first == b)
      {
        number[b] = numbers.size();
        numbers.push_back(body_numbers[b]);
      }
      else
        number[b] = number[first];
    body_numbers = numbers;
    for (unsigned int &b : body)
      b = number[b];
    number_equations(base_is_fixed ? on_base() : std::vector<bool>(n_nodes(), false));
  }

  void SolidModel::number_equations(const std::vector<bool> &fixed)
  {
    std::vector<bool> is_fixed(n_nodes(), false);
    for (unsigned int i = 0; i < n_nodes(); ++i)
      is_fixed[master[i]] = is_fixed[master[i]] || fixed[i];
    equation.assign(n_nodes(), rigid_ground);
    first_equation.assign(1, 0);
    unsigned int next = 0;
    for (unsigned int b = 0; b < n_bodies(); ++b)
    {
      for (unsigned int i = 0; i < n_nodes(); ++i)
        if (body[i] == b && master[i] == i && !is_fixed[i])
          equation[i] = next++;
      first_equation.push_back(next);
    }
    for (unsigned int i = 0; i < n_nodes(); ++i)
      equation[i] = equation[master[i]];
  }

  std::string SolidModel::place_of(const unsigned int free_node) const
  {
    const auto &p = points[std::find(equation.begin(), equation.end(), free_node) - equation.begin()];
    return place({{p[0], p[1], p[2]}});
  }

  const Material &SolidModel::material_of(const unsigned int           cell,
                                          const std::vector<Material> &materials) const
  {
    if (materials.size() == 1)
      return materials[0];
    AssertThrow(materials.size() == n_zones, ExcDimensionMismatch(materials.size(), n_zones));
    return materials[zone[cell]];
  }

  namespace
  {
    /** Returns the bodies of a model with zero stiffness matrices. */
    std::vector<Body> empty_bodies(const SolidModel &model)
    {
      std::vector<std::vector<std::vector<unsigned int>>> columns(model.n_bodies());
      for (unsigned int b = 0; b < model.n_bodies(); ++b)
        columns[b].resize(model.first_equation[b + 1] - model.first_equation[b]);
      std::vector<types::global_dof_index> dofs(model.grid->fe.n_dofs_per_cell());
      for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        const unsigned int b = model.body[dofs[0]], first = model.first_equation[b];
        for (const auto i : dofs)
          for (const auto j : dofs)
            if (model.equation[i] != rigid_ground && model.equation[j] != rigid_ground)
              columns[b][model.equation[i] - first].push_back(model.equation[j] - first);
      }
      std::vector<Body> bodies;
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
        bodies.push_back(std::move(body));
      }
      return bodies;
    }
  } // namespace

  Structure assemble_structure(const SolidModel &model, const std::vector<Material> &materials,
                               const bool incompatible_modes)
  {
    Structure structure;
    structure.mass.assign(model.first_equation.back(), Matrix3{});
    structure.added_mass.assign(model.first_equation.back(), Matrix3{});
    structure.bodies = empty_bodies(model);

    std::vector<types::global_dof_index> dofs(model.grid->fe.n_dofs_per_cell());
    CellElasticity                       stiffness(model.grid->fe, incompatible_modes);
    for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      const unsigned int b = model.body[dofs[0]];
      stiffness.reinit(cell, model.material_of(cell->active_cell_index(), materials));
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
            "An element of the mesh is so distorted that the mass of its node at " + model.place_of(i) +
            " is not positive. Use smaller elements (in a generated dam: \"Elements along\", \"Elements up\") or "
            "elements of a better shape, or set \"Elements/Degree\" to 1.");
    if (model.plane_strain)
      structure.decouple_y();
    return structure;
  }
} // namespace Voussoir
