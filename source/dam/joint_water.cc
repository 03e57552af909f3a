// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/dam/joint_water.h>

#include <algorithm>
#include <map>

namespace Voussoir
{
  using namespace dealii;

  JointWater::JointWater(const SolidModel &model, const Structure &structure)
      : structure(structure), at_upstream(structure.pairs.size(), false), neighbours(structure.pairs.size()),
        wet(structure.pairs.size(), false)
  {
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> pair_of; // joint and free node of a side
    for (unsigned int p = 0; p < structure.pairs.size(); ++p)
      for (const unsigned int node : {structure.pairs[p].node_1, structure.pairs[p].node_2})
        if (node != rigid_ground)
          pair_of[{structure.pairs[p].joint, node}] = p;
    std::vector<types::global_dof_index> dofs(model.fe.n_dofs_per_face());
    for (const auto &cell : model.dof_handler.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
      {
        const int surface = cell->face(f)->boundary_id();
        if (!cell->face(f)->at_boundary() || !is_joint_side(surface))
          continue;
        const unsigned int joint =
            surface -
            (surface > PhysicalId::joint_side_2 ? PhysicalId::joint_side_2 : PhysicalId::joint_side_1) - 1;
        std::vector<unsigned int> pairs;
        cell->face(f)->get_dof_indices(dofs);
        for (const auto node : dofs)
          if (const auto found = pair_of.find({joint, model.equation[node]}); found != pair_of.end())
          {
            pairs.push_back(found->second);
            if (model.on_surface(node, PhysicalId::upstream))
              at_upstream[found->second] = true;
          }
        for (const unsigned int p : pairs)
          neighbours[p].insert(neighbours[p].end(), pairs.begin(), pairs.end());
      }
  }

  bool JointWater::spread(const std::vector<PairState> &states, const std::function<double(double)> &pressure)
  {
    std::vector<unsigned int> reached;
    for (unsigned int p = 0; p < wet.size(); ++p)
      if (wet[p] || at_upstream[p])
        reached.push_back(p);
    std::vector<bool> seen(wet.size(), false);
    bool              any_new = false;
    while (!reached.empty())
    {
      const unsigned int p = reached.back();
      reached.pop_back();
      if (seen[p] || !(wet[p] || states[p] == PairState::open) ||
          !(pressure(structure.pairs[p].place[2]) > 0.))
        continue;
      seen[p] = true;
      any_new = any_new || !wet[p];
      wet[p] = true;
      reached.insert(reached.end(), neighbours[p].begin(), neighbours[p].end());
    }
    return any_new;
  }

  void JointWater::add_forces(const std::function<double(double)> &pressure, Unknowns &load) const
  {
    for (unsigned int p = 0; p < wet.size(); ++p)
      if (wet[p])
      {
        const Pair &pair = structure.pairs[p];
        structure.add_pair_force(pair, {{pressure(pair.place[2]) * pair.area, 0., 0.}}, load);
      }
  }

  std::vector<double> JointWater::pressures(const std::function<double(double)> &pressure) const
  {
    std::vector<double> result(wet.size(), 0.);
    for (unsigned int p = 0; p < wet.size(); ++p)
      if (wet[p])
        result[p] = pressure(structure.pairs[p].place[2]);
    return result;
  }

  unsigned int JointWater::n_wet() const
  {
    return std::count(wet.begin(), wet.end(), true);
  }
} // namespace Voussoir
