// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/dam/dam_loads.h>
#include <voussoir/dam/face_pressure.h>
#include <voussoir/dam/load_table.h>
#include <voussoir/dam/nodal_forces.h>
#include <voussoir/dam/temperature.h>

namespace Voussoir
{
  namespace
  {
    struct LoadRow
    {
      const char *name;      ///< name, also in load combinations
      bool        is_raised; ///< see StaticLoad
      bool (*acts)(const Scene &);
      void (*add)(const Scene &, const LoadSite &, StaticLoad &load);
    };

    void add_temperature(const Scene &scene, const LoadSite &site, StaticLoad &load)
    {
      InitialStrain thermal =
          temperature_load(site.model, site.materials, scene.elements.incompatible_modes,
                           scene.loads.temperature, scene.directory, scene.output.knows_tractions());
      load.force = std::move(thermal.load);
      load.stress = std::move(thermal.stress);
    }

    /** Table of all static loads. */
    const LoadRow loads[] = {
        {"water", true, [](const Scene &scene) { return scene.reservoir.density > 0.; },
         [](const Scene &scene, const LoadSite &site, StaticLoad &load)
         { add_water_pressure(site.model, scene.reservoir, scene.statics.gravity, load.force); }},
        {"weight", false, [](const Scene &scene) { return scene.statics.self_weight == "monolithic"; },
         [](const Scene &scene, const LoadSite &site, StaticLoad &load)
         { add_weight(site.structure, scene.statics.gravity, load.force); }},
        {"temperature", true, [](const Scene &scene) { return scene.loads.temperature.acts(); },
         add_temperature},
        {"tail water", true, [](const Scene &scene) { return scene.loads.tail_water.acts(); },
         [](const Scene &scene, const LoadSite &site, StaticLoad &load)
         { add_tail_water(site.model, scene.loads.tail_water, scene.statics.gravity, load.force); }},
        {"silt", true, [](const Scene &scene) { return scene.loads.silt.acts(); },
         [](const Scene &scene, const LoadSite &site, StaticLoad &load)
         { add_silt(site.model, scene.loads.silt, scene.statics.gravity, load.force); }},
        {"concentrated", true, [](const Scene &scene) { return !scene.loads.concentrated.empty(); },
         [](const Scene &scene, const LoadSite &site, StaticLoad &load)
         { add_concentrated(site.model, scene.loads, load.force); }},
        {"crest line", true, [](const Scene &scene) { return !scene.loads.crest_line.empty(); },
         [](const Scene &scene, const LoadSite &site, StaticLoad &load)
         { add_crest_line(site.model, scene.loads, load.force); }}};

    void scale(StaticLoad &load)
    {
      for (double &f : load.force)
        f *= load.factor;
      for (Stress &stress : load.stress)
        for (float &s : stress)
          s *= static_cast<float>(load.factor);
    }
  } // namespace

  std::vector<StaticLoad> static_loads(const Scene &scene, const LoadSite &site)
  {
    std::vector<StaticLoad> result;
    for (const LoadRow &load : loads)
      if (const double factor = scene.loads.factor(load.name); factor != 0. && load.acts(scene))
      {
        result.push_back({load.name, load.is_raised, factor, Unknowns(3 * site.structure.n_nodes(), 0.), {}});
        load.add(scene, site, result.back());
        if (factor != 1.)
          scale(result.back());
      }
    return result;
  }

  Vector3 StaticLoad::resultant() const
  {
    Vector3 sum{};
    for (std::size_t k = 0; k < force.size(); ++k)
      sum[k % 3] += force[k];
    return sum;
  }
} // namespace Voussoir
