// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/scene_relations.h>
#include <voussoir/motion/motion_files.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    bool has_joint(const JointParameters &joints, const std::string &model)
    {
      return joints.model == model || std::any_of(joints.overrides.begin(), joints.overrides.end(),
                                                  [&](const auto &joint) { return joint.second == model; });
    }

    /** Returns a warning about keys for which Coulomb's law has two solutions (doc/keys.md), or "". */
    std::string two_branches(const Scene &scene)
    {
      const KeyParameters &keys = scene.joints.keys;
      const double         face = scene.joints.friction, flank = keys.friction < 0. ? face : keys.friction,
                   degree = std::acos(-1.) / 180.,
                   needed = 90. - keys.flank_angle + std::atan(flank) / degree;
      if (!has_joint(scene.joints, "KSM") || keys.height == 0. || needed >= 90. ||
          face <= std::tan(needed * degree))
        return "";
      std::ostringstream text;
      text << "Joints/Friction " << face << " with flanks of " << keys.flank_angle
           << " degrees and flank friction " << flank << " (Joints/Keys): above " << std::tan(needed * degree)
           << " Coulomb's law has two solutions: a key stops at its flank, or slides up the flank. The "
              "result of the run may be either of them. Set Joints/Keys/Friction = -1, the friction of the "
              "faces, or reduce the flank angle.";
      return text.str();
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
           << temperature.day << ". Set this entry to " << last->value
           << " if it is the day of the earthquake.";
      return text.str();
    }

    std::string odd_factors(const LoadParameters &loads)
    {
      std::ostringstream text;
      for (const char *load :
           {"weight", "water", "tail water", "silt", "uplift"}) // other loads may have the opposite sign
        if (const double factor = loads.factor(load); factor < 0. || factor > 5.)
          text << (text.tellp() > 0 ? ", " : "") << load << ' ' << factor;
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
      if (scene.output.envelope_interval <= 1 ||
          (limits.tensile_strength == 0. && limits.tension == 0. && limits.compression == 0.))
        return "";
      return "Output/Envelope interval is " + std::to_string(scene.output.envelope_interval) +
             ": peaks of the stresses between are missed, so the limits of stresses are not evaluated. Set "
             "it to 1 for Limits.";
    }

    std::string no_strength(const Scene &scene)
    {
      if (!has_joint(scene.joints, "cohesive") || scene.joints.strength != 0.)
        return "";
      return "Joints/Strength is 0: the model cohesive is then FJA. Set the tensile strength of "
             "the bond, such as 1 MPa.";
    }

    bool reservoir_acts(const Scene &scene)
    {
      return scene.reservoir.density > 0. && scene.loads.factor("water") != 0.;
    }

    std::string level_of_another_dam(const Scene &scene, const std::vector<WrittenEntry> &entries)
    {
      if (scene.mesh.source != "file" || scene.reservoir.density == 0. ||
          is_written(entries, "Reservoir/Water level"))
        return "";
      std::ostringstream text;
      text << "the mesh is from a file, and there is no Reservoir/Water level: it is "
           << scene.reservoir.level
           << " m, that of arch210. Set the level of this dam, or set Reservoir/Density to 0.";
      return text.str();
    }

    /** Returns a warning if the @p level [m] of a load is above the reservoir, or an empty string. */
    std::string above_the_reservoir(const Scene &scene, const char *load, const char *entry, const bool acts,
                                    const double level, const char *then)
    {
      if (!acts || scene.loads.factor(load) == 0. || !reservoir_acts(scene) || level <= scene.reservoir.level)
        return "";
      std::ostringstream text;
      text << entry << " is " << level << " m, above the reservoir (Reservoir/Water level is "
           << scene.reservoir.level << " m): " << then << " Reduce it, or raise the reservoir.";
      return text.str();
    }

    /** Returns a warning about loads of the combination without entries, or an empty string. */
    std::string undefined_loads(const Scene &scene, const std::vector<WrittenEntry> &entries)
    {
      const LoadParameters &loads = scene.loads;
      struct Row
      {
        const char *load;
        bool        acts;
        const char *entry;
      };
      const Row rows[] = {
          {"tail water", loads.tail_water.acts(), "Loads/Tail water/Level"},
          {"silt", loads.silt.acts(), "Loads/Silt/Level"},
          {"temperature", loads.temperature.acts(), "Loads/Temperature/Upstream face or Table"},
          {"uplift", loads.uplift.joints || loads.uplift.base, "Loads/Uplift/Joints or Base"},
          {"concentrated", !loads.concentrated.empty(), "Loads/Concentrated"},
          {"crest line", !loads.crest_line.empty(), "Loads/Crest line"}};
      if (loads.combination.empty() || !is_written(entries, "Loads/Combinations"))
        return ""; // the default combinations contain all loads
      std::string names, missing;
      for (const Row &row : rows)
        if (!row.acts && loads.factor(row.load) != 0.)
        {
          names += (names.empty() ? "" : ", ") + std::string(row.load);
          missing += (missing.empty() ? "" : ", ") + std::string(row.entry);
        }
      return names.empty() ? ""
                           : "Loads/Combination " + loads.combination +
                                 " contains loads that are not defined: " + names + ". Set " + missing +
                                 ", or remove the loads from Loads/Combinations.";
    }
  } // namespace

  std::vector<std::string> odd_relations(const Scene &scene, const std::vector<WrittenEntry> &entries)
  {
    const LoadParameters    &loads = scene.loads;
    std::vector<std::string> warnings = {
        rare_envelopes(scene),
        no_strength(scene),
        level_of_another_dam(scene, entries),
        two_branches(scene),
        other_day(scene),
        odd_factors(loads),
        undefined_loads(scene, entries),
        above_the_reservoir(scene, "tail water", "Loads/Tail water/Level", loads.tail_water.acts(),
                            loads.tail_water.level, "the water presses the dam upstream."),
        above_the_reservoir(scene, "silt", "Loads/Silt/Level", loads.silt.acts(), loads.silt.level,
                            "its density is that under water (Loads/Silt/Density)."),
        is_written(entries, "Motion/Unit") ? "" : unit_warning(scene.motion, scene.directory)};
    warnings.erase(std::remove(warnings.begin(), warnings.end(), ""), warnings.end());
    return warnings;
  }
} // namespace Voussoir
