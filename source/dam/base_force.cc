// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/dam/base_force.h>
#include <voussoir/dam/base_uplift.h>
#include <voussoir/solid/cell_elasticity.h>
#include <voussoir/solid/for_faces.h>
#include <voussoir/solid/solid_grid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace Voussoir
{
  using namespace dealii;

  namespace
  {
    /** Gives every node of the model its own equation during the lifetime of the object, including fixed and
     * tied nodes. */
    class AllNodesFree
    {
    public:
      explicit AllNodesFree(SolidModel &model)
          : model(model), fixed(model.base_is_fixed), equation(model.equation),
            first_equation(model.first_equation), master(model.master)
      {
        std::iota(model.master.begin(), model.master.end(), 0);
        model.free_base();
      }
      ~AllNodesFree()
      {
        model.base_is_fixed = fixed;
        model.equation.swap(equation);
        model.first_equation.swap(first_equation);
        model.master.swap(master);
      }
      AllNodesFree(const AllNodesFree &) = delete;
      AllNodesFree &operator=(const AllNodesFree &) = delete;

    private:
      SolidModel               &model;
      const bool                fixed;
      std::vector<unsigned int> equation, first_equation, master;
    };

    Vector3 to(const Vector3 &centroid, const Vector3 &p)
    {
      return Vector3{{p[0], p[1], p[2]}} - centroid;
    }

    Matrix3 scaled_matrix(const double factor, const Matrix3 &a)
    {
      return sum(Matrix3{}, factor, a);
    }

    void add_force(Wrench &wrench, const double factor, const Vector3 &arm, const Vector3 &force)
    {
      const Vector3 moment = cross(arm, force);
      for (unsigned int c = 0; c < 3; ++c)
      {
        wrench[c] += factor * force[c];
        wrench[3 + c] += factor * moment[c];
      }
    }

    /** Adds the coefficients of the force block * x and its moment. */
    void add_block(std::array<double, 18> &part, const Vector3 &arm, const Matrix3 &block)
    {
      for (unsigned int d = 0; d < 3; ++d)
      {
        Wrench column{};
        add_force(column, 1., arm, {{block[d], block[3 + d], block[6 + d]}});
        for (unsigned int r = 0; r < 6; ++r)
          part[3 * r + d] += column[r];
      }
    }

    void add_product(Wrench &wrench, const std::array<double, 18> &part, const Vector3 &x)
    {
      for (unsigned int r = 0; r < 6; ++r)
        wrench[r] += part[3 * r] * x[0] + part[3 * r + 1] * x[1] + part[3 * r + 2] * x[2];
    }

    /** Returns BlockBase::axes. The normal is vertical if a base has no mean plane. */
    std::array<Vector3, 3> axes_of(const Vector3 &outward, const double area)
    {
      Vector3      inward{{0., 0., 1.}}, stream{{1., 0., 0.}};
      const double projection = norm(outward);
      for (unsigned int c = 0; projection > 1e-9 * area && c < 3; ++c)
        inward[c] = -outward[c] / projection;
      if (std::abs(inward[0]) > .999) // the plane has no downstream direction
        stream = {{0., 0., -1.}};
      const double out_of_plane = dot(stream, inward);
      for (unsigned int c = 0; c < 3; ++c)
        stream[c] -= out_of_plane * inward[c];
      const double length = norm(stream);
      for (double &x : stream)
        x /= length;
      return {{stream, cross(inward, stream), inward}};
    }
  } // namespace

  BaseResultants resultants(const BlockBase &base, const Wrench &wrench)
  {
    const Vector3  force{{wrench[0], wrench[1], wrench[2]}}, moment{{wrench[3], wrench[4], wrench[5]}};
    BaseResultants result;
    result.normal = -dot(force, base.axes[2]);
    for (unsigned int k = 0; k < 2; ++k)
      result.shear[k] = dot(force, base.axes[k]);
    for (unsigned int k = 0; k < 3; ++k)
      result.moment[k] = dot(moment, base.axes[k]);
    return result;
  }

  double sliding_safety(const BlockBase &base, const BaseResultants &force, const double friction,
                        const double cohesion)
  {
    const double shear = std::hypot(force.shear[0], force.shear[1]);
    return shear > 0. ? (cohesion * base.area + friction * std::max(0., -force.normal - base.uplift)) / shear
                      : std::numeric_limits<double>::infinity();
  }

  BaseForces::BaseForces(Dam &dam, const std::vector<double> &joint_water, const BasePart *part)
      : dam(dam), model(*dam.model), equation(dam.model->equation)
  {
    if (part == nullptr)
      find_bases();
    else
      of_block.push_back({0, part->area, 0., part->centroid, axes_of({}, part->area)});
    share = part == nullptr ? std::vector<double>(model.n_nodes(), 1.) : part->share;
    constant.assign(of_block.size(), Wrench{});
    stiffness.resize(of_block.size());
    mass.resize(of_block.size());
    held_mass.assign(of_block.size(), std::array<double, 18>{});
    find_supports();
    find_lone_pairs(joint_water, part);
    {
      const AllNodesFree all_free(model);
      Structure          whole; // only its masses are used
      whole.mass.assign(model.n_nodes(), Matrix3{});
      whole.added_mass = whole.mass;
      add_cells(whole);
      add_loads(whole);
      add_masses(whole);
    }
    if (dam.scene.statics.self_weight == "staged")
      add_staged_weight();
  }

  void BaseForces::find_bases()
  {
    struct Surface
    {
      Vector3 outward{}, moment{};
      double  area = 0.;
    };
    std::map<int, Surface> surfaces;
    for_faces(model, PhysicalId::base, model.degree + 1,
              [&](const FEFaceValues<3> &values, const auto &)
              {
                Surface &surface = surfaces[monolith_of(values.get_cell()->material_id())];
                for (const unsigned int q : values.quadrature_point_indices())
                {
                  surface.area += values.JxW(q);
                  for (unsigned int c = 0; c < 3; ++c)
                  {
                    surface.outward[c] += values.normal_vector(q)[c] * values.JxW(q);
                    surface.moment[c] += values.quadrature_point(q)[c] * values.JxW(q);
                  }
                }
              });
    const bool has_uplift = dam.scene.loads.uplift.base && dam.scene.loads.factor("uplift") != 0.;
    const std::map<int, Vector3> uplift =
        has_uplift ? base_uplift(dam.scene, model).of_monolith : std::map<int, Vector3>();
    for (const auto &[monolith, surface] : surfaces)
    {
      BlockBase base;
      base.monolith = monolith;
      base.area = norm(surface.outward);
      for (unsigned int c = 0; c < 3; ++c)
        base.centroid[c] = surface.moment[c] / surface.area;
      base.axes = axes_of(surface.outward, surface.area);
      if (const auto found = uplift.find(monolith); found != uplift.end())
        base.uplift = dot(found->second, base.axes[2]);
      of_block.push_back(base);
    }
  }

  /** Returns the base of a monolith, or the number of bases if there is none. A part of the base has no
   * monolith and serves all of them. */
  unsigned int BaseForces::block_of(const int monolith) const
  {
    const auto found =
        std::find_if(of_block.begin(), of_block.end(),
                     [&](const BlockBase &base) { return base.monolith == monolith || base.monolith == 0; });
    return found - of_block.begin();
  }

  /** Finds the fixed nodes and the nodes with the equation of a base node. */
  void BaseForces::find_supports()
  {
    std::set<unsigned int> supporting = {rigid_ground};
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
      if (model.on_surface(i, PhysicalId::base))
        supporting.insert(equation[i]);
    block.assign(model.n_nodes(), rigid_ground);
    std::vector<types::global_dof_index> dofs(model.grid->fe.n_dofs_per_cell());
    for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
    {
      const unsigned int b = block_of(monolith_of(cell->material_id()));
      cell->get_dof_indices(dofs);
      for (const auto i : dofs)
        if (b < of_block.size() && supporting.count(equation[i]) > 0)
          block[i] = b;
    }
  }

  /** Finds the pairs with one node on the foundation. */
  void BaseForces::find_lone_pairs(const std::vector<double> &joint_water, const BasePart *part)
  {
    const std::vector<Pair>             &pairs = dam.structure.pairs;
    std::map<unsigned int, unsigned int> block_at; // free node -> block
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
      if (block[i] != rigid_ground && equation[i] != rigid_ground)
        block_at[equation[i]] = block[i];
    for (unsigned int p = 0; p < pairs.size(); ++p)
    {
      const auto stands = [&](const unsigned int node)
      { return node == rigid_ground || block_at.count(node) > 0; };
      if (dam.layout.joints[pairs[p].joint].is_base() &&
          !joint_water.empty()) // the water in open pairs is a part of the reaction
        add_crack_water(pairs[p], joint_water[p] * pairs[p].area);
      const bool first = stands(pairs[p].node_1), second = stands(pairs[p].node_2);
      if (first == second || (part != nullptr && !part->contains(pairs[p].place)))
        continue;
      const Joint       &joint = dam.layout.joints[pairs[p].joint];
      const unsigned int b = block_of(first ? joint.monolith_1() : joint.monolith_2());
      if (b == of_block.size())
        continue;
      lone.push_back({p, b, first ? 1. : -1.});
      water.push_back(joint_water.empty() ? 0. : joint_water[p] * pairs[p].area);
    }
  }

  std::vector<double> BaseForces::uplift_by(const std::vector<double> &pressure) const
  {
    std::vector<double> result(of_block.size(), 0.);
    for (std::size_t p = 0; p < pressure.size(); ++p)
      if (const Pair &pair = dam.structure.pairs[p]; dam.layout.joints[pair.joint].is_base())
        for (std::size_t b = 0; b < of_block.size(); ++b)
          if (of_block[b].monolith == dam.layout.joints[pair.joint].monolith_2())
            result[b] += pressure[p] * pair.area * dot(pair.frame[0], of_block[b].axes[2]);
    return result;
  }

  void BaseForces::add_crack_water(const Pair &pair, const double force)
  {
    for (BlockBase &base : of_block)
      if (base.monolith == dam.layout.joints[pair.joint].monolith_2())
        base.uplift += force * dot(pair.frame[0], base.axes[2]);
  }

  /** Adds the stiffness and the lumped mass of the cells at the supports. */
  void BaseForces::add_cells(Structure &whole)
  {
    std::vector<std::map<unsigned int, std::array<double, 18>>> sums(of_block.size()), of_zones(sums);
    std::vector<types::global_dof_index>                        dofs(model.grid->fe.n_dofs_per_cell());
    CellElasticity elasticity(model.grid->fe, dam.scene.elements.incompatible_modes);
    for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      const auto contributes = [&](const auto i) { return block[i] != rigid_ground && share[i] > 0.; };
      if (std::none_of(dofs.begin(), dofs.end(), contributes))
        continue;
      const Material &material = model.material_of(cell->active_cell_index(), dam.materials);
      elasticity.reinit(cell, material);
      const double more =
          model.material_of(cell->active_cell_index(), dam.damped).young / material.young - 1.;
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (const unsigned int b = block[dofs[i]]; contributes(dofs[i]))
        {
          const Vector3 arm = to(of_block[b].centroid, model.points[dofs[i]]);
          for (unsigned int c = 0; c < 3; ++c)
            whole.mass[model.equation[dofs[i]]][4 * c] += elasticity.mass[i];
          for (unsigned int j = 0; j < dofs.size(); ++j)
            if (const unsigned int e = equation[dofs[j]]; e != rigid_ground)
            {
              const Matrix3 force = scaled_matrix(share[dofs[i]], elasticity.stiffness[i * dofs.size() + j]);
              add_block(sums[b][e], arm, force);
              if (more != 0.)
                add_block(of_zones[b][e], arm, scaled_matrix(more, force));
            }
        }
    }
    zones.resize(sums.size());
    for (unsigned int b = 0; b < sums.size(); ++b)
      for (const auto &[from, to] : {std::tie(sums[b], stiffness[b]), std::tie(of_zones[b], zones[b])})
        for (const auto &[node, part] : from)
        {
          to.node.push_back(node);
          to.part.push_back(part);
        }
  }

  /** Adds the static loads and the added mass at the supports. */
  void BaseForces::add_loads(Structure &whole)
  {
    const Scene &scene = dam.scene;
    for (const StaticLoad &load : static_loads(scene, {model, whole, dam.sustained}))
      for (unsigned int i = 0; i < model.n_nodes(); ++i)
        if (const unsigned int b = block[i]; b != rigid_ground)
          add_force(constant[b], -share[i], to(of_block[b].centroid, model.points[i]),
                    get(load.force, model.equation[i]));
    for (const StaticLoad &load : dam.loads) // at the border of a bonded part of the base
      for (unsigned int i = 0; load.name == uplift_load && dam.foundation->uses_rock() && i < model.n_nodes();
           ++i)
        if (const unsigned int b = block[i];
            b != rigid_ground && !is_footing(model.body_numbers[model.body[i]]))
          add_force(constant[b], -share[i], to(of_block[b].centroid, model.points[i]),
                    get(load.force, equation[i]));
    if (scene.reservoir.density > 0. && scene.loads.factor("water") != 0.)
      add_added_mass(model, scene.reservoir, whole);
  }

  void BaseForces::add_masses(const Structure &whole)
  {
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
      if (const unsigned int b = block[i]; b != rigid_ground && share[i] > 0.)
      {
        const bool held = equation[i] == rigid_ground;
        if (!held)
        {
          mass[b].node.push_back(equation[i]);
          mass[b].part.push_back({});
        }
        add_block(held ? held_mass[b] : mass[b].part.back(), to(of_block[b].centroid, model.points[i]),
                  scaled_matrix(share[i], whole.mass[model.equation[i]]));
      }
  }

  /** The staged weight is in no displacement, because displacements are relative to the state after it. */
  void BaseForces::add_staged_weight()
  {
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
      if (const unsigned int b = block[i]; b != rigid_ground)
        add_force(constant[b], share[i], to(of_block[b].centroid, model.points[i]),
                  get(dam.staged.reaction, i));
  }

  std::vector<Wrench> BaseForces::of(const StepOfDam &step) const
  {
    const Structure &structure = dam.structure;
    const bool       moves = step.dt > 0.;
    const double     damping = moves ? structure.damping.stiffness / step.dt : 0.;
    const auto       change = [&](const unsigned int node)
    { return get(step.after, node) - get(step.before, node); };
    std::vector<Wrench> result = constant;
    for (unsigned int b = 0; b < result.size(); ++b)
    {
      for (std::size_t k = 0; k < stiffness[b].node.size(); ++k)
      {
        const unsigned int node = stiffness[b].node[k];
        const Vector3      du = change(node);
        Vector3            u = get(step.after, node); // mean, with the damping term
        for (unsigned int c = 0; c < 3; ++c)
          u[c] += (damping - .5) * du[c] + (step.relaxation.empty() ? 0. : step.relaxation[3 * node + c]);
        add_product(result[b], stiffness[b].part[k], u);
      }
      for (std::size_t k = 0; !step.relaxation.empty() && k < zones[b].node.size(); ++k)
        add_product(result[b], zones[b].part[k],
                    get(step.lag.empty() ? step.relaxation : step.lag, zones[b].node[k]));
      for (std::size_t k = 0; moves && k < mass[b].node.size(); ++k)
      {
        const unsigned int node = mass[b].node[k];
        const Vector3      du = change(node);
        Vector3            a = get(step.acceleration, node);
        for (unsigned int c = 0; c < 3; ++c)
          a[c] += structure.damping.mass * (du[c] / step.dt - step.base_velocity[c]);
        add_product(result[b], mass[b].part[k], a);
      }
      if (moves)
        add_product(result[b], held_mass[b], step.ground);
    }
    for (unsigned int i = 0; i < step.water.size(); ++i)
      if (const unsigned int b = block[i]; b != rigid_ground)
        add_force(result[b], -share[i], to(of_block[b].centroid, model.points[i]), step.water[i]);
    for (std::size_t k = 0; k < lone.size(); ++k)
    {
      const Pair &pair = structure.pairs[lone[k].pair];
      Vector3     f = get(step.joint_force, lone[k].pair), force{};
      f[0] += water[k];
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int c = 0; c < 3; ++c)
          force[c] += pair.frame[i][c] * f[i];
      add_force(result[lone[k].block], lone[k].sign, pair.place - of_block[lone[k].block].centroid, force);
    }
    return result;
  }
} // namespace Voussoir
