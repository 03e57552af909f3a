// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/dam/dam_loads.h>
#include <voussoir/dam/staged_weight.h>
#include <voussoir/joints/joint_system.h>
#include <voussoir/mesh/mesh_joints.h>
#include <voussoir/solid/cell_elasticity.h>
#include <voussoir/solid/solid_grid.h>

#include <algorithm>

namespace Voussoir
{
  namespace
  {
    /** Returns the forces on the nodes of the model [N]: the residuals of the equilibrium at the fixed nodes, and of each block at the nodes of
   * lift joints.
   * @param weight gravity with the factor of the load combination [m/s^2]
   * @param u displacement of the free nodes under staged self-weight [m] */
    Unknowns reaction(const Scene &scene, const std::vector<Material> &sustained, const SolidModel &model,
                      const std::vector<Joint> &joints, const double weight, const Unknowns &u)
    {
      Unknowns                                     result(3 * std::size_t(model.n_nodes()), 0.);
      std::vector<dealii::types::global_dof_index> dofs(model.grid->fe.n_dofs_per_cell());
      CellElasticity    elasticity(model.grid->fe, scene.elements.incompatible_modes);
      std::vector<bool> in_joint(model.n_nodes(), false);
      for (unsigned int i = 0; i < model.n_nodes(); ++i)
        in_joint[i] =
            std::any_of(model.surfaces[i].begin(), model.surfaces[i].end(),
                        [&](const int id) {
                          return is_joint_side(id) && joints[number_of_joint(id) - 1].is_inside_monolith();
                        });
      const auto is_fixed = [&](const auto node) { return model.equation[node] == rigid_ground; };
      const auto is_held = [&](const auto node) { return is_fixed(node) || in_joint[node]; };
      for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        if (std::none_of(dofs.begin(), dofs.end(), is_held))
          continue;
        elasticity.reinit(cell, model.material_of(cell->active_cell_index(), sustained));
        for (unsigned int i = 0; i < dofs.size(); ++i)
        {
          if (!is_held(dofs[i]))
            continue;
          Vector3 force = get(result, dofs[i]);
          force[2] += weight * elasticity.mass[i];
          for (unsigned int j = 0; j < dofs.size(); ++j)
            if (!is_fixed(dofs[j]))
              add(force, elasticity.stiffness[i * dofs.size() + j] * get(u, model.equation[dofs[j]]));
          set(result, dofs[i], force);
        }
      }
      return result;
    }
  } // namespace

  StagedWeight staged_weight(const Scene &scene, const std::vector<Material> &sustained,
                             const SolidModel &model, const Structure &structure, const DamGeometry &geometry,
                             const std::vector<Joint> &joints, std::vector<Stress> &stress)
  {
    StagedWeight result;
    Unknowns     load(3 * structure.n_nodes(), 0.), u;
    const double weight = scene.loads.factor("weight") * scene.statics.gravity;
    add_weight(structure, weight, load);
    StepOperator operation;
    operation.stiffness = scene.sustained_ratio();
    JointSystem system(structure, JointLaws(), ContactParameters(), operation);
    system.solve_free(load, u);
    StressRecovery(model, sustained, scene.elements.incompatible_modes,
                   scene.output.knows_tractions() ? faces_at_nodes(model) : std::vector<NodeFace>(),
                   scene.output.knows_tractions())
        .apply(u, {}, stress);
    if (const unsigned int e = model.equation[geometry.crown]; e != rigid_ground)
      result.crown = {{u[3 * e], u[3 * e + 1], u[3 * e + 2]}};
    result.reaction = reaction(scene, sustained, model, joints, weight, u);
    return result;
  }
} // namespace Voussoir
