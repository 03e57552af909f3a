// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/dam/dam_loads.h>
#include <voussoir/dam/load_table.h>

namespace Voussoir
{
  namespace
  {
    struct LoadRow
    {
      const char *name;
      bool        is_raised; ///< see StaticLoad
      bool (*acts)(const Scene &);
      void (*add)(const Scene &, const SolidModel &, const Structure &, Unknowns &force);
    };

    /** All static loads. A new one is its own file and a row here. */
    const LoadRow loads[] = {
        {"water", true, [](const Scene &scene) { return scene.reservoir.density > 0.; },
         [](const Scene &scene, const SolidModel &model, const Structure &, Unknowns &force)
         { add_water_pressure(model, scene.reservoir, scene.statics.gravity, force); }},
        {"weight", false, [](const Scene &scene) { return scene.statics.self_weight == "monolithic"; },
         [](const Scene &scene, const SolidModel &, const Structure &structure, Unknowns &force)
         { add_weight(structure, scene.statics.gravity, force); }}};
  } // namespace

  std::vector<StaticLoad> static_loads(const Scene &scene, const SolidModel &model,
                                       const Structure &structure)
  {
    std::vector<StaticLoad> result;
    for (const LoadRow &load : loads)
      if (load.acts(scene))
      {
        result.push_back({load.name, load.is_raised, Unknowns(3 * structure.n_nodes(), 0.)});
        load.add(scene, model, structure, result.back().force);
      }
    return result;
  }
} // namespace Voussoir
