// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/scene_ranges.h>
#include <voussoir/contact/law_table.h>
#include <voussoir/dam/load_table.h>
#include <voussoir/motion/motion_files.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    /** Adds the warnings of all joint laws about their parameters. */
    void add_law_warnings(const Scene &scene, std::vector<std::string> &warnings)
    {
      const JointParameters &joints = scene.joints;
      std::set<std::string>  models = {joints.model};
      for (const auto &joint : joints.overrides)
        models.insert(joint.second);
      for (const std::string &model : models)
        warnings.push_back(joint_law_warning(model, joints.law(scene.concrete.young)));
    }

    /** Returns a warning if the last day of the stages is not Loads/Temperature/Day, or an empty string. */
    std::string other_day(const Scene &scene)
    {
      const TemperatureParameters   &temperature = scene.loads.temperature;
      const std::vector<StaticStage> stages = static_stages(scene.statics.stages);
      const auto                     last = std::find_if(stages.rbegin(), stages.rend(),
                                                         [](const StaticStage &s) { return s.kind == StaticStage::Kind::day; });
      if (last == stages.rend() || temperature.table.empty() || last->value == temperature.day)
        return "";
      std::ostringstream text;
      text << "Statics/Stages ends with day " << last->value
           << ", but the final stage has the temperatures of Loads/Temperature/Day, which is "
           << temperature.day << ". Set Loads/Temperature/Day to " << last->value
           << " if this is the day of the earthquake.";
      return text.str();
    }

    /** Returns a warning if a sustained modulus exceeds Young's modulus, or an empty string. */
    std::string stiff_sustained(const Scene &scene)
    {
      std::ostringstream text;
      for (const auto &[section, ratio] :
           {std::make_pair("Concrete", scene.sustained_ratio()),
            {"Foundation", scene.foundation.model == "rigid" ? 1. : scene.foundation.sustained_ratio()}})
        if (ratio > 1.)
          text << (text.tellp() > 0 ? " " : "") << section << "/Sustained modulus is " << ratio << " times "
               << section << "/Young's modulus, but creep reduces the modulus. Exchange or correct them.";
      return text.str();
    }

    std::string odd_factors(const LoadParameters &loads)
    {
      std::ostringstream text;
      for (const LoadRow &load : load_table())
        if (const double factor = loads.factor(load.name);
            !load.is_reversible && (factor < 0. || factor > 5.))
          text << (text.tellp() > 0 ? ", " : "") << load.name << ' ' << factor;
      if (text.tellp() == 0)
        return "";
      return "Loads/Combination is " + loads.combination + ", with " + text.str() +
             ". Usual factors are 0 to 5. Check Loads/Combinations.";
    }

    bool is_written(const std::vector<WrittenEntry> &entries, const std::string &name)
    {
      return std::any_of(entries.begin(), entries.end(),
                         [&](const WrittenEntry &entry) { return entry.declared.name() == name; });
    }

    std::string rare_envelopes(const Scene &scene)
    {
      const LimitParameters &limits = scene.limits;
      if (scene.output.envelope_interval.samples <= 1 ||
          (limits.static_strength() == 0. && limits.tension == 0. && limits.compression == 0.))
        return "";
      return "Output/Envelope interval is " + std::to_string(scene.output.envelope_interval.samples) +
             ": peaks of the stresses between are missed, so the limits of stresses are not evaluated. Set "
             "Output/Envelope interval to 1 for these limits (section Limits).";
    }

    std::string assumed_static_strength(const LimitParameters &limits)
    {
      const bool is_used =
          limits.demand_capacity > 0. || limits.overstress_seconds > 0. || limits.overstress_share > 0.;
      if (!is_used || limits.static_tensile_strength > 0. || limits.tensile_strength == 0.)
        return "";
      std::ostringstream text;
      text
          << "there is no Limits/Static tensile strength, to which the demand-capacity ratio, the duration and the share "
             "of overstress refer: two thirds of Limits/Tensile strength, "
          << 1e-6 * limits.static_strength() << " MPa, is used. Set the static strength of splitting tests.";
      return text.str();
    }

    bool reservoir_acts(const Scene &scene)
    {
      return scene.reservoir.density > 0. && scene.loads.factor("water") != 0.;
    }

    std::string level_of_another_dam(const Scene &scene, const std::vector<WrittenEntry> &entries)
    {
      if (scene.mesh.source == "arch210" || scene.reservoir.density == 0. ||
          is_written(entries, "Reservoir/Water level"))
        return "";
      std::ostringstream text;
      text << "the dam is not arch210, and there is no Reservoir/Water level: it is " << scene.reservoir.level
           << " m, the default for the dam arch210. Set the level of this dam, or set Reservoir/Density "
              "to 0.";
      return text.str();
    }

    /** Adds warnings about loads with a level above that of the reservoir. */
    void add_levels_above_the_reservoir(const Scene &scene, std::vector<std::string> &warnings)
    {
      for (const LoadRow &load : load_table())
        if (load.above_reservoir && load.acts(scene) && scene.loads.factor(load.name) != 0. &&
            reservoir_acts(scene) && load.level(scene) > scene.reservoir.level)
        {
          std::ostringstream text;
          text << load.level_entry << " is " << load.level(scene)
               << " m, above the reservoir (Reservoir/Water level is " << scene.reservoir.level
               << " m): " << load.above_reservoir << " Reduce it, or raise the reservoir.";
          warnings.push_back(text.str());
        }
    }

    /** Returns a warning about loads of the combination without entries, or an empty string. */
    std::string undefined_loads(const Scene &scene, const std::vector<WrittenEntry> &entries)
    {
      const LoadParameters &loads = scene.loads;
      if (loads.combination.empty() || !is_written(entries, "Loads/Combinations"))
        return ""; // the default combinations contain all loads
      std::string names, missing;
      for (const LoadRow &load : load_table())
        if (load.defined_by && !load.acts(scene) && loads.factor(load.name) != 0.)
        {
          names += (names.empty() ? "" : ", ") + std::string(load.name);
          missing += (missing.empty() ? "" : ", ") + std::string(load.defined_by);
        }
      return names.empty() ? ""
                           : "Loads/Combination " + loads.combination +
                                 " contains loads that are not defined: " + names + ". Set " + missing +
                                 ", or remove the loads from Loads/Combinations.";
    }
  } // namespace

  std::vector<Warning> odd_relations(const Scene &scene, const std::vector<WrittenEntry> &entries)
  {
    std::vector<std::string> texts = {rare_envelopes(scene),
                                      level_of_another_dam(scene, entries),
                                      other_day(scene),
                                      odd_factors(scene.loads),
                                      undefined_loads(scene, entries),
                                      stiff_sustained(scene),
                                      assumed_static_strength(scene.limits)};
    add_levels_above_the_reservoir(scene, texts);
    if (!is_written(entries, "Motion/Unit"))
      texts.push_back(unit_warning(scene.motion, scene.directory));
    add_law_warnings(scene, texts);
    std::vector<Warning> warnings;
    for (const std::string &text : texts)
      if (!text.empty())
        warnings.push_back({Warning::Kind::physics, text, ""});
    if (scene.reservoir.kind() != scene.reservoir.model)
      warnings.push_back(
          {Warning::Kind::input,
           "Reservoir/Added mass is an entry of older versions. Replace it by Reservoir/Model = " +
               scene.reservoir.kind() + ".",
           "Reservoir/Added mass"});
    return warnings;
  }
} // namespace Voussoir
