// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/entries.h>
#include <voussoir/base/model_choices.h>
#include <voussoir/base/names.h>
#include <voussoir/dam/dam_loads.h>
#include <voussoir/dam/face_pressure.h>
#include <voussoir/dam/force_history.h>
#include <voussoir/dam/load_names.h>
#include <voussoir/dam/load_table.h>
#include <voussoir/dam/nodal_forces.h>
#include <voussoir/dam/temperature.h>

#include <algorithm>

namespace Voussoir
{
  namespace
  {
    /** Returns the row of a load with the given member of LoadParameters. */
    template <auto parameters> LoadRow load_of(const char *name, const unsigned int order)
    {
      return {name, order, [](const Scene &scene) { return (scene.loads.*parameters).acts(); },
              [](LoadParameters &loads, Entries &prm) { (loads.*parameters).add_parameters(prm); }};
    }

    LoadRow weight()
    {
      LoadRow row{"weight", 1, [](const Scene &scene) { return scene.statics.self_weight != "none"; }};
      row.is_staged = [](const Scene &scene) { return scene.statics.self_weight == "staged"; };
      row.is_raised = false;
      row.is_by_gravity = true;
      row.add = [](const Scene &scene, const LoadSite &site, StaticLoad &load)
      { add_weight(site.structure, scene.statics.gravity, load.force); };
      return row;
    }

    LoadRow water()
    {
      LoadRow row{"water", 0, [](const Scene &scene) { return scene.reservoir.density > 0.; }};
      row.is_by_gravity = true;
      row.level_entry = "Reservoir/Water level";
      row.level = [](const Scene &scene) { return scene.reservoir.level; };
      row.help = "with its added mass";
      row.traction = water_traction;
      row.surface = PhysicalId::upstream;
      row.idle = {{"Reservoir/Density is 0",
                   [](const Scene &scene) { return scene.reservoir.density == 0.; },
                   {"Reservoir/", "Loads/Uplift/Joints"},
                   {"Reservoir/Density"}},
                  {"Reservoir/Model is not Westergaard",
                   [](const Scene &scene) { return scene.reservoir.model != "Westergaard"; },
                   {"Reservoir/Added mass"}},
                  {"the added mass is not by Westergaard's formula (Reservoir/Model)",
                   [](const Scene &scene) { return scene.reservoir.kind().rfind("Westergaard", 0) != 0; },
                   {"Reservoir/Factor", "Reservoir/Depth"}},
                  {"Reservoir/Model is not acoustic",
                   [](const Scene &scene) { return scene.reservoir.model != "acoustic"; },
                   {"Reservoir/Sound speed", "Reservoir/Reflection", "Output/Pressure depths"}},
                  {"Reservoir/Model is neither acoustic nor incompressible",
                   [](const Scene &scene) {
                     return scene.reservoir.model != "acoustic" && scene.reservoir.model != "incompressible";
                   },
                   {"Reservoir/Length", "Reservoir/Element size"}},
                  {"Reservoir/Model is not added mass table",
                   [](const Scene &scene) { return scene.reservoir.model != "added mass table"; },
                   {"Reservoir/Table"}}};
      return row;
    }

    LoadRow tail_water()
    {
      LoadRow row = load_of<&LoadParameters::tail_water>("tail water", 3);
      row.is_by_gravity = true;
      row.level = [](const Scene &scene) { return scene.loads.tail_water.level; };
      row.level_entry = row.defined_by = "Loads/Tail water/Level";
      row.above_reservoir = "the water then presses the dam upstream.";
      row.traction = tail_water_traction;
      row.surface = PhysicalId::downstream;
      row.idle = {{"there is no tail water (Loads/Tail water/Level)",
                   [](const Scene &scene) { return scene.loads.tail_water.level <= no_level; },
                   {"Loads/Tail water/"}}};
      return row;
    }

    LoadRow silt()
    {
      LoadRow row = load_of<&LoadParameters::silt>("silt", 4);
      row.is_by_gravity = true;
      row.level = [](const Scene &scene) { return scene.loads.silt.level; };
      row.level_entry = row.defined_by = "Loads/Silt/Level";
      row.above_reservoir = "its density is that under water (Loads/Silt/Density).";
      row.traction = silt_traction;
      row.surface = PhysicalId::upstream;
      row.idle = {{"there is no silt (Loads/Silt/Level)",
                   [](const Scene &scene) { return scene.loads.silt.level <= no_level; },
                   {"Loads/Silt/"}},
                  {"Loads/Silt/Coefficient is given",
                   [](const Scene &scene) { return scene.loads.silt.coefficient >= 0.; },
                   {"Loads/Silt/Friction angle"}}};
      return row;
    }

    LoadRow temperature()
    {
      LoadRow row = load_of<&LoadParameters::temperature>("temperature", 2);
      row.defined_by = "Loads/Temperature/Upstream face or Table";
      row.is_reversible = true;
      row.add = [](const Scene &scene, const LoadSite &site, StaticLoad &load)
      {
        InitialStrain thermal =
            temperature_load(site.model, site.materials, scene.elements.incompatible_modes,
                             scene.loads.temperature, scene.directory, scene.output.knows_tractions());
        load.force = std::move(thermal.load);
        load.stress = std::move(thermal.stress);
      };
      row.idle = {{"Loads/Temperature/Table has the temperatures of the faces",
                   [](const Scene &scene) { return !scene.loads.temperature.table.empty(); },
                   {"Loads/Temperature/Upstream face", "Loads/Temperature/Downstream face"}},
                  {"there is no Loads/Temperature/Table",
                   [](const Scene &scene) { return scene.loads.temperature.table.empty(); },
                   {"Loads/Temperature/Day"}},
                  {"the dam has the temperature of the grouting",
                   [](const Scene &scene) { return !scene.loads.temperature.acts(); },
                   {"Loads/Temperature/"}}};
      return row;
    }

    /** Returns the row of the uplift in joints (StaticState) and at the base (base_uplift()). */
    LoadRow uplift()
    {
      LoadRow row = load_of<&LoadParameters::uplift>("uplift", 7);
      row.is_raised = false;
      row.defined_by = "Loads/Uplift/Joints or Base";
      row.idle = {{"Loads/Uplift/Base is false",
                   [](const Scene &scene) { return !scene.loads.uplift.base; },
                   {"Loads/Uplift/Drain position", "Loads/Uplift/Drain efficiency"}},
                  {"Loads/Uplift/Joints is false",
                   [](const Scene &scene) { return !scene.loads.uplift.joints; },
                   {"Loads/Uplift/Below closed part"}},
                  {"Loads/Uplift/Joints and Base are false",
                   [](const Scene &scene) { return !scene.loads.uplift.acts(); },
                   {"Loads/Uplift/In earthquake"}}};
      return row;
    }

    LoadRow concentrated()
    {
      LoadRow row{"concentrated", 5, [](const Scene &scene) { return !scene.loads.concentrated.empty(); }};
      row.defined_by = "Loads/Concentrated";
      row.is_reversible = true;
      row.add = [](const Scene &scene, const LoadSite &site, StaticLoad &load)
      { add_concentrated(site.model, scene.loads, load.force); };
      return row;
    }

    LoadRow force_history()
    {
      LoadRow row{"force history", 8, [](const Scene &scene) { return !scene.loads.force_history.empty(); }};
      row.help = "its first value in the static state";
      row.defined_by = "Loads/Force history";
      row.is_reversible = true;
      row.add = [](const Scene &scene, const LoadSite &site, StaticLoad &load)
      {
        for (const ForceInTime &force : forces_in_time(scene, site.model, site.structure, 1.))
          for (std::size_t k = 0; k < load.force.size(); ++k)
            load.force[k] += force.value.front() * force.pattern[k];
      };
      return row;
    }

    LoadRow crest_line()
    {
      LoadRow row{"crest line", 6, [](const Scene &scene) { return !scene.loads.crest_line.empty(); }};
      row.defined_by = "Loads/Crest line";
      row.is_reversible = true;
      row.add = [](const Scene &scene, const LoadSite &site, StaticLoad &load)
      { add_crest_line(site.model, scene.loads, load.force); };
      row.idle = {{"there is no Loads/Crest line",
                   [](const Scene &scene) { return scene.loads.crest_line.empty(); },
                   {"Loads/Crest edge"}}};
      return row;
    }

    /** Returns the rows of the table, sorted by LoadRow::order. */
    std::vector<const LoadRow *> rows_by_order()
    {
      std::vector<const LoadRow *> rows;
      for (const LoadRow &row : load_table())
        rows.push_back(&row);
      std::sort(rows.begin(), rows.end(),
                [](const LoadRow *a, const LoadRow *b) { return a->order < b->order; });
      return rows;
    }

    void scale(StaticLoad &load)
    {
      for (double &f : load.force)
        f *= load.factor;
      for (double &f : load.on_fixed)
        f *= load.factor;
      for (Stress &stress : load.stress)
        for (float &s : stress)
          s *= static_cast<float>(load.factor);
    }
  } // namespace

  // A new load has its own files, its parameters and a row here.
  const std::vector<LoadRow> &load_table()
  {
    static const std::vector<LoadRow> table = {weight(),       water(),       tail_water(),
                                               silt(),         temperature(), uplift(),
                                               concentrated(), crest_line(),  force_history()};
    return table;
  }

  std::string static_load_names()
  {
    return names_of(load_table(), ", ");
  }

  std::string static_load_docs()
  {
    return listed(load_table(), [](const LoadRow &row)
                  { return row.name + (*row.help == '\0' ? "" : " (" + std::string(row.help) + ")"); });
  }

  void add_load_parameters(LoadParameters &loads, Entries &prm)
  {
    for (const LoadRow *row : rows_by_order())
      if (row->declare)
        row->declare(loads, prm);
  }

  void add_load_choices(const Scene &scene, ModelChoices &choices)
  {
    std::vector<const LoadRow *> active;
    for (const LoadRow &row : load_table())
      if (row.acts(scene) && scene.loads.factor(row.name) != 0.)
        active.push_back(&row);
    for (const LoadRow *without : active)
    {
      if (without->is_by_gravity && !without->defined_by) // weight and water have other changes
        continue;
      std::string combination;
      for (const LoadRow *row : active)
        if (row != without)
          combination += row->name + (" " + number_text(scene.loads.factor(row->name))) + ", ";
      combination += "earthquake " + number_text(scene.loads.factor("earthquake"));
      choices.add("loads", "without " + std::string(without->name),
                  {{"Loads/Combinations", "needs: " + combination}, {"Loads/Combination", "needs"}}, true);
    }
  }

  std::vector<StaticLoad> static_loads(const Scene &scene, const LoadSite &site)
  {
    std::vector<StaticLoad> result;
    for (const LoadRow *load : rows_by_order())
      if (const double factor = scene.loads.factor(load->name); (load->add || load->traction) &&
                                                                factor != 0. && load->acts(scene) &&
                                                                !(load->is_staged && load->is_staged(scene)))
      {
        result.push_back(
            {load->name, load->is_raised, factor, Unknowns(3 * site.structure.n_nodes(), 0.), {}});
        if (load->add)
          load->add(scene, site, result.back());
        else
          result.back().on_fixed = add_traction(
              site.model, load->surface,
              [&](const double z, const Vector3 &normal) { return load->traction(scene, 1., z, normal); },
              result.back().force);
        if (factor != 1.)
          scale(result.back());
        site.structure.remove_held_forces(result.back().force);
      }
    return result;
  }

  KnownTraction known_traction(const Scene &scene)
  {
    std::vector<std::pair<const LoadRow *, double>> parts; // active rows with load factors
    for (const LoadRow &load : load_table())
      if (load.traction && load.acts(scene))
        parts.emplace_back(&load, scene.loads.factor(load.name));
    return [&scene, parts](const int surface, const double z, const Vector3 &normal)
    {
      Vector3 sum{};
      for (const auto &[load, factor] : parts)
        if (load->surface == surface)
          add(sum, load->traction(scene, factor, z, normal));
      return sum;
    };
  }

  Vector3 StaticLoad::resultant() const
  {
    Vector3 sum = on_fixed;
    for (std::size_t k = 0; k < force.size(); ++k)
      sum[k % 3] += force[k];
    return sum;
  }
} // namespace Voussoir
