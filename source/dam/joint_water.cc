// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/dam/dam.h>
#include <voussoir/dam/face_distance.h>
#include <voussoir/dam/joint_water.h>
#include <voussoir/solid/solid_grid.h>
#include <voussoir/solid/solid_model.h>

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
    std::vector<types::global_dof_index> dofs(model.grid->fe.n_dofs_per_face());
    for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
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

  std::vector<bool> JointWater::reached(const std::vector<bool> &passes) const
  {
    std::vector<unsigned int> next;
    std::vector<bool>         result(passes.size(), false);
    const auto                reach = [&](const unsigned int p)
    {
      if (passes[p] && !result[p])
      {
        result[p] = true;
        next.push_back(p);
      }
    };
    for (unsigned int p = 0; p < passes.size(); ++p)
      if (wet[p] || at_upstream[p])
        reach(p);
    while (!next.empty())
    {
      const unsigned int p = next.back();
      next.pop_back();
      for (const unsigned int q : neighbours[p])
        reach(q);
    }
    return result;
  }

  bool JointWater::spread(const std::vector<PairState> &states, const std::function<double(double)> &pressure)
  {
    std::vector<bool> passes(wet.size());
    for (unsigned int p = 0; p < wet.size(); ++p)
      passes[p] = (wet[p] || states[p] == PairState::open) && pressure(structure.pairs[p].place[2]) > 0.;
    const std::vector<bool> now = reached(passes);
    bool                    any_new = false;
    for (unsigned int p = 0; p < wet.size(); ++p)
      if (now[p] && !wet[p])
        wet[p] = any_new = true;
    return any_new;
  }

  void JointWater::add_forces(const std::function<double(double)> &pressure, Unknowns &load) const
  {
    const std::vector<double> now = pressures(pressure);
    for (unsigned int p = 0; p < now.size(); ++p)
      if (now[p] != 0.)
        structure.add_pair_force(structure.pairs[p], {{now[p] * structure.pairs[p].area, 0., 0.}}, load);
  }

  std::vector<double> JointWater::pressures(const std::function<double(double)> &pressure) const
  {
    std::vector<double> result(wet.size(), 0.);
    for (unsigned int p = 0; p < wet.size(); ++p)
      result[p] = wet[p] ? pressure(structure.pairs[p].place[2]) : below_closed_part(p, pressure);
    return result;
  }

  /** Returns the pressure of seep() in a pair that is not under water pressure [Pa]. */
  double JointWater::below_closed_part(const unsigned int                   p,
                                       const std::function<double(double)> &pressure) const
  {
    if (place.empty() || place[p] < 0.)
      return 0.;
    const Pair  &pair = structure.pairs[p];
    double       distance = 1e300;
    unsigned int source = p;
    for (unsigned int q = 0; q < wet.size(); ++q)
      if (structure.pairs[q].joint == pair.joint && (wet[q] || at_upstream[q]))
        if (const double d = norm(structure.pairs[q].place - pair.place);
            d < (1. - 1e-9) * distance ||
            (d < (1. + 1e-9) * distance && structure.pairs[q].place[2] < structure.pairs[source].place[2]))
          distance = d, source = q; // the lower one of two at equal distances
    const double toe = at_toe(pair.place[2]), full = pressure(structure.pairs[source].place[2]);
    if (place[source] >= 1.)
      return 0.;
    return toe + (full - toe) * std::clamp((1. - place[p]) / (1. - place[source]), 0., 1.);
  }

  unsigned int JointWater::n_wet() const
  {
    return std::count(wet.begin(), wet.end(), true);
  }

  JointWater joint_water(const Dam &dam)
  {
    JointWater   water(*dam.model, dam.structure);
    const Scene &scene = dam.scene;
    if (scene.loads.uplift.below_closed_part != "linear")
      return water;
    const std::vector<double> in_thickness =
        places_in_thickness(*dam.model, "Loads/Uplift/Below closed part", true);
    std::map<unsigned int, double> of_node;
    for (unsigned int i = 0; i < dam.model->n_nodes(); ++i)
      of_node[dam.model->equation[i]] = in_thickness[i];
    std::vector<double> place;
    for (const Pair &pair : dam.structure.pairs)
      place.push_back(dam.layout.joints[pair.joint].is_base() ? of_node.at(pair.node_2) : -1.);
    const TailWaterParameters &tail = scene.loads.tail_water;
    const double weight = tail.density * scene.statics.gravity * scene.loads.factor("tail water") *
                          scene.loads.factor("uplift");
    water.seep(std::move(place),
               [weight, level = tail.level](const double z) { return weight * std::max(0., level - z); });
    return water;
  }
} // namespace Voussoir
