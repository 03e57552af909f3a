// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/scene_warnings.h>
#include <voussoir/contact/law_table.h>
#include <voussoir/dam/dam.h>

#include <algorithm>
#include <cstdlib>

namespace Voussoir
{
  namespace
  {
    bool is_arch210(const Scene &scene)
    {
      return scene.mesh.source == "arch210";
    }
    bool is_generated_without_joints(const Scene &scene)
    {
      const auto has_none = [](const ArchGrid &grid)
      { return grid.n_joints == 0 && grid.lift_joints == 0 && !grid.base_joint; };
      return is_arch210(scene) ? has_none(scene.mesh.arch210)
                               : scene.mesh.source == "arcs" && has_none(scene.mesh.arcs.complete_grid());
    }
    bool needs_rock(const Scene &scene)
    {
      return foundation_reads(scene.foundation.model, "Foundation/Young's modulus");
    }
    bool all_tied(const Scene &scene)
    {
      const auto &others = scene.joints.overrides;
      return scene.joints.model == "tied" &&
             std::all_of(others.begin(), others.end(),
                         [](const auto &entry) { return entry.second == "tied"; });
    }
    /** Returns whether any load with the given property acts. */
    bool any_acts(const Scene &scene, bool LoadRow::*which)
    {
      const auto &loads = load_table();
      return std::any_of(loads.begin(), loads.end(),
                         [&](const LoadRow &load) { return load.*which && load.acts(scene); });
    }

    /** Entries without effect because of other choices. */
    const std::vector<IdleEntries> relations = {
        {"Mesh/Source is not arch210", [](const Scene &s) { return !is_arch210(s); }, {"Mesh/Arch210/"}},
        {"Mesh/Source is not arcs", [](const Scene &s) { return s.mesh.source != "arcs"; }, {"Mesh/Arcs/"}},
        {"Mesh/Source is not file",
         [](const Scene &s) { return s.mesh.source != "file"; },
         {"Mesh/File", "Mesh/Axes", "Mesh/Length unit", "Mesh/Subdivide"}},
        {"Mesh/Arch210/Rock/Enabled is false and the foundation is rigid",
         [](const Scene &s) { return !s.mesh.arch210_rock.enabled && !needs_rock(s); },
         {"Mesh/Arch210/Rock/"},
         {"Mesh/Arch210/Rock/Enabled"}},
        {"Mesh/Arcs/Rock/Enabled is false and the foundation is rigid",
         [](const Scene &s) { return !s.mesh.arcs_rock.enabled && !needs_rock(s); },
         {"Mesh/Arcs/Rock/"},
         {"Mesh/Arcs/Rock/Enabled"}},
        {"Mesh/Arcs/Joint chainages sets the joints",
         [](const Scene &s) { return !s.mesh.arcs.grid.joint_places.empty(); },
         {"Mesh/Arcs/Joints"}},
        {"Mesh/Arcs/Rows sets the rows of elements",
         [](const Scene &s) { return !s.mesh.arcs.grid.rows.empty(); },
         {"Mesh/Arcs/Elements up"}},
        {"Elements/Degree is 2",
         [](const Scene &s) { return s.elements.degree == 2; },
         {"Elements/Incompatible modes"}},
        {"no load is applied in increments (the water, or a load of section Loads)",
         [](const Scene &s) { return !any_acts(s, &LoadRow::is_raised); },
         {"Statics/Water increments"}},
        {"Output/Block forces is false",
         [](const Scene &s) { return !s.output.block_forces; },
         {"Limits/Base friction", "Limits/Base cohesion"}},
        {"there is no Limits/Wedges",
         [](const Scene &s) { return s.limits.wedges.empty(); },
         {"Limits/Wedge safety"}},
        {"the dam has no joints (Mesh/Arch210/Joints or Mesh/Arcs/Joints)",
         is_generated_without_joints,
         {"Joints/", "Loads/Uplift/Joints", "Loads/Uplift/In earthquake", "Loads/Uplift/Below closed part",
          "Contact/", "Dynamics/Impact"}},
        {"all joints are tied (Joints/Model, Joints/Overrides)",
         all_tied,
         {"Joints/", "Loads/Uplift/Joints", "Loads/Uplift/In earthquake", "Loads/Uplift/Below closed part",
          "Contact/", "Dynamics/Impact"},
         {"Joints/Model", "Joints/Overrides"}},
        {"Contact/Write problems is false",
         [](const Scene &s) { return !s.contact.write_problems; },
         {"Contact/Write interval"}},
        {"Statics/Self-weight is none, and there are no water, silt and rock wedges",
         [](const Scene &s) { return !any_acts(s, &LoadRow::is_by_gravity) && s.limits.wedges.empty(); },
         {"Statics/Gravity"}},
        {"the matrix factors are always in double precision on subcycled rock, and on massless rock that is not one "
         "body with the dam",
         [](const Scene &s)
         {
           return (s.foundation.model == "rock" && s.foundation.is_subcycled()) ||
                  (s.foundation.model == "massless" && s.mesh.source != "file" &&
                   !is_generated_without_joints(s) && !Dam::is_one_body(s, all_tied(s)));
         },
         {"Dynamics/Factors"}},
        {"Motion/Source is none",
         [](const Scene &s) { return s.motion.source == "none" && !s.moves_alone(); },
         {"Motion/", "Dynamics/", "Damping/"},
         {"Motion/Source"}},
        {"Motion/Source is none",
         [](const Scene &s) { return s.motion.source == "none"; },
         {"Motion/"},
         {"Motion/Source", "Motion/Duration", "Motion/Time step"}},
        {"The damping is uniform",
         [](const Scene &s) { return s.damping.is_uniform(); },
         {"Damping/Frequency 1", "Damping/Frequency 2", "Damping/Mass coefficient",
          "Damping/Stiffness coefficient"}},
        {"The damping is of Rayleigh's model",
         [](const Scene &s) { return !s.damping.is_uniform(); },
         {"Damping/Band begin", "Damping/Band end", "Damping/Terms", "Damping/Reference frequency",
          "Damping/Zones"}},
        {"Damping/Mass coefficient and Stiffness coefficient are given",
         [](const Scene &s) { return s.damping.mass_coefficient >= 0. && !s.is_for_modes; },
         {"Damping/Ratio", "Damping/Frequency 1", "Damping/Frequency 2"}},
        {"Dynamics/Scheme is explicit",
         [](const Scene &s) { return s.is_explicit(); },
         {"Dynamics/Factors", "Foundation/Substeps", "Foundation/Coupling"}},
        {"Dynamics/Scheme is not explicit",
         [](const Scene &s) { return !s.is_explicit(); },
         {"Dynamics/Explicit step", "Dynamics/Mass scaling"}},
        {"Motion/Source is artificial",
         [](const Scene &s) { return s.motion.source == "artificial"; },
         {"Motion/File", "Motion/File x", "Motion/File y", "Motion/File z", "Motion/File step",
          "Motion/Azimuths", "Motion/Baseline", "Motion/Match", "Motion/Match band"}},
        {"Motion/Source is artificial, and there is no Motion/Target spectrum",
         [](const Scene &s) { return s.motion.source == "artificial" && s.motion.target_file.empty(); },
         {"Motion/Unit"}},
        {"Motion/Source is file",
         [](const Scene &s) { return s.motion.source == "file"; },
         {"Motion/Spectrum", "Motion/Characteristic period", "Motion/Maximum beta",
          "Motion/Peak acceleration", "Motion/Seed", "Motion/Rise end", "Motion/Decay begin",
          "Motion/Decay rate"}},
        {"Motion/Source is file, without Motion/Target spectrum",
         [](const Scene &s) { return s.motion.source == "file" && s.motion.target_file.empty(); },
         {"Motion/Vertical ratio"}},
        {"Motion/Source is file, and Motion/Match is not true",
         [](const Scene &s) { return s.motion.source == "file" && s.motion.match != "true"; },
         {"Motion/Matching iterations"}},
        {"Motion/Match is not scale",
         [](const Scene &s) { return s.motion.match != "scale"; },
         {"Motion/Match band"}},
        {"Motion/Target spectrum is given",
         [](const Scene &s) { return !s.motion.target_file.empty(); },
         {"Motion/Spectrum", "Motion/Characteristic period", "Motion/Maximum beta",
          "Motion/Peak acceleration"}},
        {"Motion/Sequence is given",
         [](const Scene &s) { return s.motion.source == "artificial" && !s.motion.sequence.empty(); },
         {"Motion/Seed"}},
        {"Motion/Ensemble is given",
         [](const Scene &s) { return s.motion.source == "artificial" && !s.motion.ensemble.empty(); },
         {"Motion/Seed"}},
        {"Foundation/Nodal quadrature everywhere is true and Foundation/Layers at the dam is 0",
         [](const Scene &s) { return s.foundation.nodal_everywhere && s.foundation.layers_at_dam == 0; },
         {"Foundation/Nodal layers"}},
    };

    /** Returns all conditions under which entries have no effect. The first true condition is reported. */
    std::vector<IdleEntries> rules()
    {
      std::vector<IdleEntries> all;
      for (const LoadRow &load : load_table())
        all.insert(all.end(), load.idle.begin(), load.idle.end());
      all.insert(all.end(), relations.begin(), relations.end());
      return all;
    }

    bool is_default(const WrittenEntry &entry)
    {
      const std::string &value = entry.value, &standard = entry.declared.default_value;
      char              *end_1, *end_2;
      const double       a = std::strtod(value.c_str(), &end_1), b = std::strtod(standard.c_str(), &end_2);
      const bool         numbers = !value.empty() && !standard.empty() && *end_1 == '\0' && *end_2 == '\0';
      return numbers ? a == b : value == standard;
    }

    std::string without_effect(const std::vector<const WrittenEntry *> &entries, const std::string &reason)
    {
      const auto text = [](const WrittenEntry *entry)
      { return entry->declared.name() + " (" + entry->place + ")"; };
      return listed(entries, text) + (entries.size() == 1 ? " has" : " have") + " no effect: " + reason +
             ". Remove the " + (entries.size() == 1 ? "entry" : "entries") + ", or change this condition.";
    }

    /** Returns the reason why the entry has no effect, or an empty string if it has an effect. */
    std::string why_idle(const Scene &scene, const std::string &name)
    {
      static const EntryNames of_modes = {"Damping/",       "Motion/Factor",  "Motion/Scale x",
                                          "Motion/Scale y", "Motion/Scale z", "Motion/Vertical ratio"};
      if (scene.is_for_modes && includes(of_modes, name))
        return "";
      if (name.rfind("Foundation/", 0) == 0 && !foundation_reads(scene.foundation.model, name))
        return "Foundation/Model is " + scene.foundation.model;
      for (const IdleEntries &rule : rules())
        if (includes(rule.entries, name) && !includes(rule.exceptions, name) && rule.holds(scene))
          return rule.reason;
      const std::string laws = joint_laws_with(name);
      return laws.empty() || scene.joints.any_reads(name)
                 ? ""
                 : "no joint has a suitable model (" + laws + "); Joints/Model is " + scene.joints.model;
    }
  } // namespace

  std::vector<Warning> scene_warnings(const Scene &scene, const std::vector<WrittenEntry> &entries,
                                      const UsualRanges &usual)
  {
    std::vector<Warning>                                                   warnings;
    std::vector<std::pair<std::string, std::vector<const WrittenEntry *>>> idle; // by reason
    std::vector<UsedValue>                                                 values = values_of_sources(scene);
    for (const WrittenEntry &entry : entries)
    {
      if (is_default(entry))
        continue;
      const std::string reason = why_idle(scene, entry.declared.name());
      if (reason.empty())
      {
        values.push_back(used_value(entry));
        continue;
      }
      auto same = std::find_if(idle.begin(), idle.end(), [&](const auto &i) { return i.first == reason; });
      if (same == idle.end())
        same = idle.insert(idle.end(), {reason, {}});
      same->second.push_back(&entry);
    }
    for (const UsedValue &value : values)
      if (const std::string warning = implausible(value, usual); !warning.empty())
        warnings.push_back({Warning::Kind::physics, warning, value.place});
    for (const auto &[reason, without] : idle)
      warnings.push_back({Warning::Kind::input, without_effect(without, reason), without.front()->place});
    for (const Warning &warning : odd_relations(scene, entries))
      warnings.push_back(warning);
    return warnings;
  }

  std::vector<std::string> entries_with_warnings()
  {
    std::vector<std::string> entries;
    for (const IdleEntries &rule : rules())
      for (const auto *list : {&rule.entries, &rule.exceptions})
        entries.insert(entries.end(), list->begin(), list->end());
    return entries;
  }
} // namespace Voussoir
