// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/scene_warnings.h>
#include <voussoir/dam/dam.h>
#include <voussoir/motion/motion_files.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    bool any_joint(const Scene &scene, const std::vector<std::string> &models)
    {
      const auto is_one = [&](const std::string &model)
      { return std::find(models.begin(), models.end(), model) != models.end(); };
      const JointParameters &joints = scene.joints;
      return is_one(joints.model) || std::any_of(joints.overrides.begin(), joints.overrides.end(),
                                                 [&](const auto &joint) { return is_one(joint.second); });
    }

    bool is_arch210(const Scene &scene)
    {
      return scene.mesh.source == "arch210";
    }
    bool is_generated_without_joints(const Scene &scene)
    {
      return is_arch210(scene) && scene.mesh.arch210.n_joints == 0;
    }
    bool all_tied(const Scene &scene)
    {
      const auto &others = scene.joints.overrides;
      return scene.joints.model == "tied" &&
             std::all_of(others.begin(), others.end(),
                         [](const auto &entry) { return entry.second == "tied"; });
    }
    bool no_water(const Scene &scene)
    {
      return scene.reservoir.density == 0.;
    }

    bool nothing_is_raised(const Scene &scene)
    {
      const LoadParameters &loads = scene.loads;
      return no_water(scene) && !loads.temperature.acts() && !loads.tail_water.acts() && !loads.silt.acts() &&
             loads.concentrated.empty() && loads.crest_line.empty();
    }

    /** When the condition holds, the entries have no effect, but for the exceptions. An entry that ends in a
     *  slash stands for all below it. */
    struct Rule
    {
      const char                        *reason;
      std::function<bool(const Scene &)> holds;
      std::vector<std::string>           entries, exceptions;
    };

    /** The first that holds is the one that is told. */
    const std::vector<Rule> rules = {
        {"Mesh/Source is file", [](const Scene &s) { return !is_arch210(s); }, {"Mesh/Arch210/"}, {}},
        {"Mesh/Source is arch210",
         is_arch210,
         {"Mesh/File", "Mesh/Axes", "Mesh/Length unit", "Mesh/Subdivide"},
         {}},
        {"Mesh/Arch210/Rock/Enabled is false",
         [](const Scene &s) { return !s.mesh.arch210_rock.enabled; },
         {"Mesh/Arch210/Rock/"},
         {"Mesh/Arch210/Rock/Enabled"}},
        {"Elements/Degree is 2",
         [](const Scene &s) { return s.elements.degree == 2; },
         {"Elements/Incompatible modes"},
         {}},
        {"Reservoir/Density is 0", no_water, {"Reservoir/", "Loads/Uplift/Joints"}, {"Reservoir/Density"}},
        {"no load is raised, neither water nor one of Loads",
         nothing_is_raised,
         {"Statics/Water increments"},
         {}},
        {"Loads/Temperature/Table has the temperatures of the faces",
         [](const Scene &s) { return !s.loads.temperature.table.empty(); },
         {"Loads/Temperature/Upstream face", "Loads/Temperature/Downstream face"},
         {}},
        {"there is no Loads/Temperature/Table",
         [](const Scene &s) { return s.loads.temperature.table.empty(); },
         {"Loads/Temperature/Day"},
         {}},
        {"the dam has the temperature of the grouting",
         [](const Scene &s) { return !s.loads.temperature.acts(); },
         {"Loads/Temperature/"},
         {}},
        {"Loads/Tail water/Level says that there is none",
         [](const Scene &s) { return s.loads.tail_water.level <= no_level; },
         {"Loads/Tail water/"},
         {}},
        {"Loads/Silt/Level says that there is none",
         [](const Scene &s) { return s.loads.silt.level <= no_level; },
         {"Loads/Silt/"},
         {}},
        {"Loads/Silt/Coefficient is given",
         [](const Scene &s) { return s.loads.silt.coefficient >= 0.; },
         {"Loads/Silt/Friction angle"},
         {}},
        {"Loads/Uplift/Base is false",
         [](const Scene &s) { return !s.loads.uplift.base; },
         {"Loads/Uplift/Drain position", "Loads/Uplift/Drain efficiency"},
         {}},
        {"Output/Block forces is false",
         [](const Scene &s) { return !s.output.block_forces; },
         {"Limits/Base friction", "Limits/Base cohesion"},
         {}},
        {"there is no Loads/Crest line",
         [](const Scene &s) { return s.loads.crest_line.empty(); },
         {"Loads/Crest edge"},
         {}},
        {"Reservoir/Added mass is none",
         [](const Scene &s) { return s.reservoir.added_mass == "none"; },
         {"Reservoir/Factor", "Reservoir/Depth"},
         {}},
        {"the dam has no joints (Mesh/Arch210/Joints)",
         is_generated_without_joints,
         {"Joints/", "Loads/Uplift/Joints", "Contact/", "Dynamics/Impact"},
         {}},
        {"all joints are tied (Joints/Model, Joints/Overrides)",
         all_tied,
         {"Joints/", "Loads/Uplift/Joints", "Contact/", "Dynamics/Impact"},
         {"Joints/Model", "Joints/Overrides"}},
        {"no joint slides with friction: Joints/Model is FJB",
         [](const Scene &s) {
           return !any_joint(s, {"FJA", "KSM", "cohesive"});
         },
         {"Joints/Friction"},
         {}},
        {"no joint has the model KSM (Joints/Model, Joints/Overrides)",
         [](const Scene &s) { return !any_joint(s, {"KSM"}); },
         {"Joints/Keys/"},
         {}},
        {"no joint has the model cohesive (Joints/Model, Joints/Overrides)",
         [](const Scene &s) { return !any_joint(s, {"cohesive"}); },
         {"Joints/Strength", "Joints/Fracture energy"},
         {}},
        {"Contact/Write problems is false",
         [](const Scene &s) { return !s.contact.write_problems; },
         {"Contact/Write interval"},
         {}},
        {"Statics/Self-weight is none and there is no water",
         [](const Scene &s)
         {
           return s.statics.self_weight == "none" && no_water(s) && !s.loads.tail_water.acts() &&
                  !s.loads.silt.acts();
         },
         {"Statics/Gravity"},
         {}},
        {"a dam that rock with steps of its own, or massless rock, leads by its feet has them in double "
         "precision",
         [](const Scene &s)
         {
           return (s.foundation.model == "rock" && s.foundation.has_own_steps()) ||
                  (s.foundation.model == "massless" && !Dam::is_one_body(s, all_tied(s)));
         },
         {"Dynamics/Factors"},
         {}},
        {"Motion/Source is none",
         [](const Scene &s) { return s.motion.source == "none"; },
         {"Motion/", "Dynamics/", "Damping/"},
         {"Motion/Source"}},
        {"Motion/Source is artificial",
         [](const Scene &s) { return s.motion.source == "artificial"; },
         {"Motion/File", "Motion/File x", "Motion/File y", "Motion/File z", "Motion/Unit"},
         {}},
        {"Motion/Source is file",
         [](const Scene &s) { return s.motion.source == "file"; },
         {"Motion/Spectrum", "Motion/Characteristic period", "Motion/Maximum beta",
          "Motion/Peak acceleration", "Motion/Vertical ratio", "Motion/Seed", "Motion/Rise end",
          "Motion/Decay begin", "Motion/Decay rate", "Motion/Matching iterations"},
         {}},
        {"Foundation/Model is rigid",
         [](const Scene &s) { return s.foundation.model == "rigid"; },
         {"Foundation/"},
         {"Foundation/Model"}},
        {"Foundation/Model is massless",
         [](const Scene &s) { return s.foundation.model == "massless"; },
         {"Foundation/"},
         {"Foundation/Model", "Foundation/Young's modulus", "Foundation/Poisson's ratio",
          "Foundation/Zones"}},
        {"Foundation/Nodal quadrature everywhere is true and Foundation/Layers at the dam is 0",
         [](const Scene &s) { return s.foundation.nodal_everywhere && s.foundation.layers_at_dam == 0; },
         {"Foundation/Nodal layers"},
         {}},
    };

    bool names(const std::vector<std::string> &list, const std::string &entry)
    {
      return std::any_of(list.begin(), list.end(),
                         [&](const std::string &name)
                         { return name.back() == '/' ? entry.rfind(name, 0) == 0 : entry == name; });
    }

    bool is_default(const WrittenEntry &entry)
    {
      const std::string &value = entry.value, &standard = entry.declared.default_value;
      char              *end_1, *end_2;
      const double       a = std::strtod(value.c_str(), &end_1), b = std::strtod(standard.c_str(), &end_2);
      const bool         numbers = !value.empty() && !standard.empty() && *end_1 == '\0' && *end_2 == '\0';
      return numbers ? a == b : value == standard;
    }

    std::string without_effect(const std::vector<const WrittenEntry *> &entries, const char *reason)
    {
      std::string text;
      for (const WrittenEntry *entry : entries)
        text += (text.empty() ? "" : ", ") + entry->declared.name() + " (" + entry->place + ")";
      return text + (entries.size() == 1 ? " has" : " have") + " no effect: " + reason + ".";
    }

    /** Keys for which Coulomb's law itself has two branches (reference: contact, 12). */
    std::string two_branches(const Scene &scene)
    {
      const KeyParameters &keys = scene.joints.keys;
      const double         face = scene.joints.friction, flank = keys.friction < 0. ? face : keys.friction,
                   degree = std::acos(-1.) / 180.,
                   needed = 90. - keys.flank_angle + std::atan(flank) / degree;
      if (!any_joint(scene, {"KSM"}) || keys.height == 0. || needed >= 90. ||
          face <= std::tan(needed * degree))
        return "";
      std::ostringstream text;
      text << "Joints/Friction " << face << " beside flanks of " << keys.flank_angle
           << " degrees with friction " << flank << " (Joints/Keys): above " << std::tan(needed * degree)
           << " Coulomb's law has two solutions, a key that stays before its flank and one that rides on it, "
              "and which is found is not determined. Give the flanks the friction of the faces "
              "(Joints/Keys/Friction = -1), or a smaller angle.";
      return text.str();
    }
    /** The last stage has the temperatures of Loads/Temperature/Day, whatever day the stages end with. */
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
           << ", but its last stage always goes to the temperatures of Loads/Temperature/Day, which is "
           << temperature.day << ". Set that to " << last->value << ", if it is the day of the earthquake.";
      return text.str();
    }

    std::string odd_factors(const LoadParameters &loads)
    {
      std::ostringstream text;
      for (const char *load : {"weight", "water", "tail water", "silt", "uplift"}) // others may be reversed
        if (const double factor = loads.factor(load); factor < 0. || factor > 5.)
          text << (text.tellp() > 0 ? ", " : "") << load << ' ' << factor;
      if (text.tellp() == 0)
        return "";
      return "Loads/Combination is " + loads.combination + ", with " + text.str() +
             ": usual are factors of 0 to 5.";
    }

    bool is_written(const std::vector<WrittenEntry> &entries, const std::string &name)
    {
      return std::any_of(entries.begin(), entries.end(),
                         [&](const WrittenEntry &entry) { return entry.declared.name() == name; });
    }
  } // namespace

  std::vector<std::string> scene_warnings(const Scene &scene, const std::vector<WrittenEntry> &entries)
  {
    std::vector<std::string>                       warnings;
    std::vector<std::vector<const WrittenEntry *>> idle(rules.size());
    for (const WrittenEntry &entry : entries)
    {
      if (is_default(entry))
        continue;
      const std::string name = entry.declared.name();
      const auto        rule =
          std::find_if(rules.begin(), rules.end(),
                       [&](const Rule &r)
                       { return names(r.entries, name) && !names(r.exceptions, name) && r.holds(scene); });
      if (rule != rules.end())
        idle[rule - rules.begin()].push_back(&entry);
      else if (const std::string warning = implausible(entry); !warning.empty())
        warnings.push_back(warning);
    }
    for (std::size_t r = 0; r < rules.size(); ++r)
      if (!idle[r].empty())
        warnings.push_back(without_effect(idle[r], rules[r].reason));
    const LimitParameters &limits = scene.limits;
    if (scene.output.envelope_interval > 1 &&
        (limits.tensile_strength > 0. || limits.tension > 0. || limits.compression > 0.))
      warnings.push_back(
          "Output/Envelope interval is " + std::to_string(scene.output.envelope_interval) +
          ": peaks of the stresses between are missed, so the limits of stresses are not evaluated. Set it "
          "to 1 for Limits.");
    if (any_joint(scene, {"cohesive"}) && scene.joints.strength == 0.)
      warnings.push_back("Joints/Strength is 0: the model cohesive is then FJA. Set the tensile strength of "
                         "the bond, such as 1 MPa.");
    if (scene.mesh.source == "file" && !no_water(scene) && !is_written(entries, "Reservoir/Water level"))
    {
      std::ostringstream text;
      text << "the mesh is from a file, and there is no Reservoir/Water level: it is "
           << scene.reservoir.level
           << " m, that of arch210. Give the level of this dam, or set Reservoir/Density to 0.";
      warnings.push_back(text.str());
    }
    for (const std::string &warning :
         {two_branches(scene), other_day(scene), odd_factors(scene.loads),
          is_written(entries, "Motion/Unit") ? "" : unit_warning(scene.motion, scene.directory)})
      if (!warning.empty())
        warnings.push_back(warning);
    return warnings;
  }

  std::vector<std::string> entries_with_warnings()
  {
    std::vector<std::string> entries;
    for (const Rule &rule : rules)
      for (const auto *list : {&rule.entries, &rule.exceptions})
        entries.insert(entries.end(), list->begin(), list->end());
    for (const std::string &entry : entries_with_ranges())
      entries.push_back(entry);
    return entries;
  }
} // namespace Voussoir
