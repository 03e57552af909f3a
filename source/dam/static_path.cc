// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/dam/static_path.h>

#include <algorithm>
#include <iomanip>
#include <limits>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    constexpr double endless = std::numeric_limits<double>::infinity();

    bool has(const std::vector<StaticStage> &stages, const StaticStage::Kind kind)
    {
      return std::any_of(stages.begin(), stages.end(), [&](const StaticStage &s) { return s.kind == kind; });
    }

    std::string in_words(const char *what, const double value)
    {
      std::ostringstream text;
      text << what << value;
      return text.str();
    }

    /** Returns the heights of the lower and the upper end of the upstream face [m]. */
    std::pair<double, double> upstream_face(const Dam &dam)
    {
      double bottom = endless, top = -endless;
      for (unsigned int i = 0; i < dam.model->n_nodes(); ++i)
        if (dam.model->on_surface(i, PhysicalId::upstream))
        {
          bottom = std::min(bottom, dam.model->points[i][2]);
          top = std::max(top, dam.model->points[i][2]);
        }
      return {bottom, top};
    }

    /** Returns true if the state depends on the path of the loads: a base or lift joint has friction, a stiffness or a
     * strength. */
    bool needs_path(const Dam &dam)
    {
      for (std::size_t p = 0; p < dam.structure.pairs.size() && !dam.scene.statics.stages.empty(); ++p)
        if (const JointLaw &law = *dam.layout.laws.of_pair[p];
            dam.layout.is_cast(dam.structure.pairs[p]) && !dam.is_tied(p) && law.flat_friction() != 0. &&
            (law.n_memory() > 0 || !law.is_tangentially_tied()))
          return true;
      return false;
    }
  } // namespace

  StaticPath::StaticPath(const Dam &dam) : dam(dam), is_dependent(needs_path(dam))
  {
    add_stages();
    StaticPart &last = add_empty_part("end", dam.scene.reservoir.level, endless);
    for (const StaticLoad &load : dam.loads)
      for (std::size_t i = 0; load.is_raised && i < last.raised.size(); ++i)
        last.raised[i] += load.force[i];
  }

  /** Throws InputError for stages that other entries exclude. */
  void StaticPath::check_stages(const std::vector<StaticStage> &stages, const bool has_lifts) const
  {
    const std::string entry = "Entry \"Statics/Stages\"";
    if (has(stages, StaticStage::Kind::day) && dam.scene.loads.temperature.table.empty())
      throw InputError(entry + " has days, but there is no temperature table. Set "
                               "\"Loads/Temperature/Table\", or remove the days.");
    if (has(stages, StaticStage::Kind::fill) && dam.scene.reservoir.density == 0.)
      throw InputError(entry +
                       " fills the reservoir, but \"Reservoir/Density\" is 0. Set it to 1000, or remove the "
                       "levels.");
    if (has_lifts && dam.scene.statics.self_weight == "monolithic")
      throw InputError(entry +
                       " grouts joints in lifts, but \"Statics/Self-weight\" = monolithic applies the "
                       "weight to the finished dam. Set it to staged, or remove the lifts.");
    if (has(stages, StaticStage::Kind::fill) && dam.scene.loads.factor("water") == 0.)
      throw InputError(entry + " fills the reservoir, but the load combination leaves the water out. Add "
                               "it to \"Loads/Combinations\", or remove the levels.");
    if (has_lifts && dam.layout.n_contraction == 0)
      throw InputError(entry +
                       " grouts joints, but the dam has no contraction joints. Remove the lifts (grout), or "
                       "set the number of joints of the mesh.");
    if (has_lifts &&
        std::all_of(dam.layout.joints.begin(), dam.layout.joints.end(),
                    [&](const Joint &joint)
                    { return !joint.is_contraction() || dam.layout.models[joint.number - 1] == "tied"; }))
      throw InputError(entry + " grouts joints, but all contraction joints are tied. Set another "
                               "\"Joints/Model\", or remove the lifts.");
  }

  void StaticPath::add_stages()
  {
    const std::vector<StaticStage> stages = static_stages(dam.scene.statics.stages);
    const bool                     has_days = has(stages, StaticStage::Kind::day),
               has_lifts = has(stages, StaticStage::Kind::grout);
    check_stages(stages, has_lifts);
    Scene at = dam.scene;                          // the input file at a stage
    at.reservoir.level = upstream_face(dam).first; // empty: the water level is at the lower end of the face
    if (has_days)                                  // no temperature load before the first day
      at.loads.temperature = TemperatureParameters();
    double grouted = grouted_at_start = has_lifts ? -endless : endless;
    for (const StaticStage &stage : stages)
      switch (stage.kind)
      {
      case StaticStage::Kind::grout:
        add_grout(stage, at, grouted);
        grouted = stage.value;
        break;
      case StaticStage::Kind::cut:
        add_cut(stage, at, grouted);
        break;
      case StaticStage::Kind::fill:
        check_fill(stage.value);
        at.reservoir.level = stage.value;
        add_part(in_words("fill ", stage.value) + " m", at, grouted);
        break;
      case StaticStage::Kind::day:
        at.loads.temperature = dam.scene.loads.temperature;
        at.loads.temperature.day = stage.value;
        add_part(in_words("day ", stage.value), at, grouted);
      }
  }

  void StaticPath::add_grout(const StaticStage &stage, const Scene &at, const double grouted)
  {
    if (stage.value <= grouted)
      throw InputError("Entry \"Statics/Stages\": \"" + in_words("grout ", stage.value) +
                       "\" is not above the previous lift. List the lifts in ascending order.");
    check_grout(stage.value);
    if (stage.pressure == 0.)
      return;
    StaticPart &part = add_part(
        in_words("grout ", stage.value) + in_words(" m at ", 1e-6 * stage.pressure) + " MPa", at, grouted);
    part.fluid_to = stage.value;
    part.pressure = stage.pressure;
  }

  void StaticPath::add_cut(const StaticStage &stage, const Scene &at, const double grouted)
  {
    const std::string entry = "Entry \"Statics/Stages\" cuts ";
    StaticPart       &part =
        add_part("cut " + stage.joint + in_words(" by ", 1e3 * stage.value) + " mm", at, grouted);
    part.cut = dam.layout.named(stage.joint, entry);
    part.width = stage.value;
    for (const std::size_t j : part.cut)
      if (dam.layout.models[j] == "tied")
        throw InputError(entry + dam.layout.joints[j].name() +
                         ", but this joint is tied. Set another model (\"Joints/Model\" or "
                         "\"Joints/Overrides\"), or remove the cut.");
  }

  /** Adds a stage without loads, after that with the weight alone if it is the first one. */
  StaticPart &StaticPath::add_empty_part(const std::string &name, const double level, const double grouted)
  {
    const Unknowns none(3 * std::size_t(dam.structure.n_nodes()), 0.);
    if (parts.empty() && is_dependent)
      parts.push_back({"weight alone", upstream_face(dam).first, grouted, none});
    parts.push_back({name, level, grouted, none});
    return parts.back();
  }

  StaticPart &StaticPath::add_part(const std::string &name, const Scene &at, const double grouted)
  {
    StaticPart &part = add_empty_part(name, at.reservoir.level, grouted);
    for (const StaticLoad &load : static_loads(at, {*dam.model, dam.structure, dam.sustained}))
      for (std::size_t i = 0; load.is_raised && i < part.raised.size(); ++i)
        part.raised[i] += load.force[i];
    return part;
  }

  void StaticPath::check_fill(const double level) const
  {
    const auto [bottom, top] = upstream_face(dam);
    const double allowed = 1e-6 * dam.size;
    if (level >= bottom - allowed && level <= top + allowed)
      return;
    std::ostringstream text;
    text << std::setprecision(8) << "Entry \"Statics/Stages\": the level " << level << " m is "
         << (level > top ? "above the dam, whose top is at "
                         : "below the upstream face, whose lower end is at ")
         << (level > top ? top : bottom) << " m. " << (level > top ? "Reduce" : "Increase")
         << " the level; it is a height in the axes of the scene, not a depth.";
    throw InputError(text.str());
  }

  void StaticPath::check_grout(const double height)
  {
    double bottom = endless, top = -endless;
    for (const Pair &pair : dam.structure.pairs)
      if (!dam.layout.is_cast(pair))
      {
        bottom = std::min(bottom, pair.place[2]);
        top = std::max(top, pair.place[2]);
      }
    const auto [dam_bottom, dam_top] = upstream_face(dam);
    const double       allowed = 1e-6 * dam.size;
    std::ostringstream text;
    text << std::setprecision(8) << "Entry \"Statics/Stages\": the height " << height << " m of a lift is ";
    if (height < bottom)
      text
          << "below all joints, whose lower end is at " << bottom
          << " m, so that no joint is grouted. Increase it; it is a height in the axes of the scene, not a depth.";
    else
      text << "above the joints, whose top is at " << top
           << " m: all joints are grouted. Reduce it, or check the axes and the length unit of the mesh.";
    if (height < std::min(bottom, dam_bottom) - allowed)
      throw InputError(text.str());
    if (height < bottom || height > std::max(top, dam_top) + allowed)
      warned.push_back(text.str());
  }

  double StaticPath::grouted_before(const std::size_t stage) const
  {
    return stage == 0 ? grouted_at_start : parts[stage - 1].grouted;
  }

  Unknowns StaticPath::load(const std::size_t stage, const double share) const
  {
    const Unknowns &to = parts[stage].raised;
    Unknowns        sum(to.size());
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] = share * to[i];
    if (stage > 0)
    {
      const Unknowns &from = parts[stage - 1].raised;
      for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += (1. - share) * from[i];
    }
    for (const StaticLoad &load : dam.loads)
      for (std::size_t i = 0; !load.is_raised && i < sum.size(); ++i)
        sum[i] += load.force[i];
    for (std::size_t p = 0; p < dam.structure.pairs.size(); ++p)
      if (const double pressure = grout_pressure(stage, share, p); pressure > 0.)
        dam.structure.add_pair_force(dam.structure.pairs[p],
                                     {{pressure * dam.structure.pairs[p].area, 0., 0.}}, sum);
    return sum;
  }

  double StaticPath::water_pressure(const std::size_t stage, const double share, const double z) const
  {
    const auto   depth = [&](const StaticPart &part) { return std::max(0., part.level - z); };
    const double before = stage == 0 ? 0. : depth(parts[stage - 1]);
    return dam.scene.reservoir.density * dam.scene.statics.gravity * dam.scene.loads.factor("water") *
           (share * depth(parts[stage]) + (1. - share) * before);
  }

  double StaticPath::grout_pressure(const std::size_t stage, const double share, const std::size_t pair) const
  {
    const double      z = dam.structure.pairs[pair].place[2];
    const StaticPart &part = parts[stage];
    const bool        is_fluid = z > part.grouted && z <= part.fluid_to &&
                          !dam.layout.is_cast(dam.structure.pairs[pair]) && !dam.is_tied(pair);
    return is_fluid ? share * part.pressure : 0.;
  }

  double StaticPath::cut_width(const std::size_t stage, const std::size_t joint) const
  {
    const std::vector<std::size_t> &cut = parts[stage].cut;
    return std::find(cut.begin(), cut.end(), joint) == cut.end() ? 0. : parts[stage].width;
  }

  PairLaws laws_up_to(const double grouted, const Dam &dam, const PairLaws &ungrouted)
  {
    PairLaws laws = dam.layout.laws;
    for (std::size_t p = 0; p < laws.of_pair.size(); ++p)
      if (const Pair &pair = dam.structure.pairs[p];
          pair.place[2] > grouted && !dam.layout.is_cast(pair) && !dam.is_tied(p))
        laws.of_pair[p] = ungrouted.of_pair[p];
    return laws;
  }
} // namespace Voussoir
