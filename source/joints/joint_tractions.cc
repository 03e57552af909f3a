// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <voussoir/joints/joint_tractions.h>
#include <voussoir/solid/solid_grid.h>
#include <voussoir/solid/solid_model.h>

#include <map>

namespace Voussoir
{
  using namespace dealii;

  namespace
  {
    using Rows = std::vector<std::map<unsigned int, double>>;

    /** Returns the mass matrix of the faces of all sides 1 [m^2], by pairs; of base joints that of sides 2. */
    Rows face_mass(const SolidModel &model, const std::vector<Pair> &pairs)
    {
      std::map<std::pair<unsigned int, unsigned int>, unsigned int> pair_at; // (surface, free node) -> pair
      for (unsigned int p = 0; p < pairs.size(); ++p)
        if (pairs[p].is_base)
          pair_at[{PhysicalId::joint_side_2 + pairs[p].joint + 1, pairs[p].node_2}] = p;
        else
          pair_at[{PhysicalId::joint_side_1 + pairs[p].joint + 1, pairs[p].node_1}] = p;
      Rows            rows(pairs.size());
      FEFaceValues<3> values(model.grid->fe, QGauss<2>(model.degree + 1), update_values | update_JxW_values);
      std::vector<types::global_dof_index>               dofs(model.grid->fe.n_dofs_per_cell());
      std::vector<std::pair<unsigned int, unsigned int>> here; // (pair, number in the cell)
      for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
        for (const unsigned int f : cell->face_indices())
        {
          const unsigned int surface = cell->face(f)->boundary_id();
          if (!cell->face(f)->at_boundary() || !is_joint_side(surface) ||
              (surface > PhysicalId::joint_side_2 && model.base_joints.count(surface) == 0))
            continue;
          cell->get_dof_indices(dofs);
          here.clear();
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (const auto found = pair_at.find({surface, model.equation[dofs[i]]});
                found != pair_at.end() && model.grid->fe.has_support_on_face(i, f))
              here.emplace_back(found->second, i);
          values.reinit(cell, f);
          for (const unsigned int q : values.quadrature_point_indices())
            for (const auto &i : here)
              for (const auto &j : here)
                rows[i.first][j.first] +=
                    values.shape_value(i.second, q) * values.shape_value(j.second, q) * values.JxW(q);
        }
      return rows;
    }
  } // namespace

  JointTractions::JointTractions(const SolidModel &model, const Structure &structure) : structure(structure)
  {
    for (const auto &row : face_mass(model, structure.pairs))
    {
      double sum = 0.;
      for (const auto &entry : row)
        sum += entry.second;
      mean.emplace_back();
      for (const auto &entry : row)
        mean.back().emplace_back(entry.first, entry.second / sum);
    }
  }
} // namespace Voussoir
