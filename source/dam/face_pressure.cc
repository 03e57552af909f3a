// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <voussoir/dam/face_pressure.h>

#include <algorithm>

namespace Voussoir
{
  using namespace dealii;

  Unknowns nodal_forces(const SolidModel &model, const int surface, const double level,
                        const Traction &traction)
  {
    Unknowns                             force(3 * std::size_t(model.n_nodes()), 0.);
    FEFaceValues<3>                      values(model.fe, QGauss<2>(8),
                                                update_values | update_normal_vectors | update_JxW_values |
                                                    update_quadrature_points);
    std::vector<types::global_dof_index> dofs(model.fe.n_dofs_per_cell());
    for (const auto &cell : model.dof_handler.active_cell_iterators())
      for (const unsigned int face : cell->face_indices())
        if (cell->face(face)->at_boundary() && static_cast<int>(cell->face(face)->boundary_id()) == surface)
        {
          values.reinit(cell, face);
          cell->get_dof_indices(dofs);
          for (const unsigned int q : values.quadrature_point_indices())
            if (const double depth = level - values.quadrature_point(q)[2]; depth > 0.)
            {
              const Tensor<1, 3> t = values.JxW(q) * traction(depth, values.normal_vector(q));
              for (unsigned int i = 0; i < dofs.size(); ++i)
                for (unsigned int c = 0; c < 3; ++c)
                  force[3 * dofs[i] + c] += values.shape_value(i, q) * t[c];
            }
        }
    return force;
  }

  namespace
  {
    /** The part on nodes that are free. */
    void add_to_free(const SolidModel &model, const Unknowns &force, Unknowns &load)
    {
      for (unsigned int i = 0; i < model.n_nodes(); ++i)
        for (unsigned int c = 0; model.equation[i] != rigid_ground && c < 3; ++c)
          load[3 * std::size_t(model.equation[i]) + c] += force[3 * std::size_t(i) + c];
    }
  } // namespace

  namespace
  {
    Vector3 scaled(const double factor, const Vector3 &v)
    {
      return {{factor * v[0], factor * v[1], factor * v[2]}};
    }

    Vector3 of_silt(const SiltParameters &silt, const double vertical, const Vector3 &normal)
    {
      const double lateral = -vertical * silt.pressure_coefficient();
      return {{lateral * normal[0], lateral * normal[1], -vertical * std::max(0., normal[2])}};
    }
  } // namespace

  KnownTraction known_traction(const Scene &scene)
  {
    const double gravity = scene.statics.gravity;
    const auto  &loads = scene.loads;
    const double water = loads.factor("water") * scene.reservoir.density * gravity,
                 tail = loads.tail_water.acts()
                            ? loads.factor("tail water") * loads.tail_water.density * gravity
                            : 0.,
                 sediment = loads.silt.acts() ? loads.factor("silt") * loads.silt.density * gravity : 0.;
    const double level = scene.reservoir.level;
    return [=](const int surface, const double z, const Vector3 &normal)
    {
      Vector3      t{};
      const double below_tail = loads.tail_water.level - z, below_silt = loads.silt.level - z;
      if (surface == PhysicalId::upstream && z < level)
        add(t, scaled(-water * (level - z), normal));
      if (surface == PhysicalId::upstream && sediment > 0. && below_silt > 0.)
        add(t, of_silt(loads.silt, sediment * below_silt, normal));
      if (surface == PhysicalId::downstream && tail > 0. && below_tail > 0.)
        add(t, scaled(-tail * below_tail, normal));
      return t;
    };
  }

  void add_tail_water(const SolidModel &model, const TailWaterParameters &water, const double gravity,
                      Unknowns &load)
  {
    const double weight = water.density * gravity;
    add_to_free(model,
                nodal_forces(model, PhysicalId::downstream, water.level,
                             [=](const double depth, const Tensor<1, 3> &normal)
                             { return -weight * depth * normal; }),
                load);
  }

  void add_silt(const SolidModel &model, const SiltParameters &silt, const double gravity, Unknowns &load)
  {
    const double weight = silt.density * gravity, lateral = silt.pressure_coefficient();
    add_to_free(model,
                nodal_forces(model, PhysicalId::upstream, silt.level,
                             [=](const double depth, const Tensor<1, 3> &normal)
                             {
                               Tensor<1, 3> t = -weight * depth * lateral * normal;
                               t[2] = -weight * depth * std::max(0., normal[2]);
                               return t;
                             }),
                load);
  }
} // namespace Voussoir
