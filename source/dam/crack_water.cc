// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/dam/crack_water.h>

#include <algorithm>

namespace Voussoir
{
  CrackWater::CrackWater(const Dam &dam, const StaticState &statics)
      : dam(dam), statics(statics), water(joint_water(dam)), at_rest(statics.joint_water)
  {
    const std::vector<Pair> &pairs = dam.structure.pairs;
    at_rest.resize(pairs.size(), 0.);
    change.assign(pairs.size(), 0.);
    of_step = change;
    for (const StaticLoad &load : dam.loads)
      for (std::size_t p = 0; load.name == uplift_load && p < pairs.size(); ++p)
        if (dam.layout.joints[pairs[p].joint].is_base())
          at_rest[p] = dot(pairs[p].frame[0], get(load.force, pairs[p].node_2)) / pairs[p].area;
  }

  double CrackWater::full(const std::size_t pair) const
  {
    const Scene &scene = dam.scene;
    return scene.loads.factor("uplift") * scene.loads.factor("water") * scene.reservoir.density *
           scene.statics.gravity * std::max(0., scene.reservoir.level - dam.structure.pairs[pair].place[2]);
  }

  void CrackWater::advance(Unknowns &load)
  {
    of_step = change;
    for (std::size_t p = 0; p < change.size(); ++p)
      if (const Pair &pair = dam.structure.pairs[p]; change[p] != 0.)
        dam.structure.add_pair_force(pair, {{change[p] * pair.area, 0., 0.}}, load);
  }

  void CrackWater::update_from_dam(const DynamicState &state)
  {
    constexpr double         closed = 1e-7; // largest opening of a closed pair [m]
    std::vector<bool>        open, passes;
    const std::vector<Pair> &pairs = dam.structure.pairs;
    for (std::size_t p = 0; p < pairs.size(); ++p)
    {
      open.push_back(dam.structure.jump(pairs[p], state.u)[0] - statics.closed[3 * p] > closed);
      passes.push_back(open[p] && full(p) > 0.);
    }
    const bool              is_full = dam.scene.loads.uplift.in_earthquake == "full";
    const std::vector<bool> reached = water.reached(passes);
    for (std::size_t p = 0; p < pairs.size(); ++p)
    {
      const bool is_new =
          open[p] && statics.pairs[p] != PairState::open && dam.layout.joints[pairs[p].joint].is_base();
      const bool has_water = reached[p] && (is_new || dam.scene.loads.uplift.joints);
      change[p] = is_full ? (has_water ? full(p) - at_rest[p] : 0.) : is_new ? -at_rest[p] : 0.;
    }
  }
} // namespace Voussoir
