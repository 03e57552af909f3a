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
  } // namespace

  StaticPath::StaticPath(const Dam &dam) : dam(dam), increments(dam.scene.statics.water_increments)
  {
    add_stages();
    StaticPart last{"end", dam.scene.reservoir.level, endless,
                    Unknowns(3 * std::size_t(dam.structure.n_nodes()), 0.)};
    for (const StaticLoad &load : dam.loads)
      for (std::size_t i = 0; load.is_raised && i < last.raised.size(); ++i)
        last.raised[i] += load.force[i];
    parts.push_back(std::move(last));
  }

  void StaticPath::add_stages()
  {
    const std::vector<StaticStage> stages = static_stages(dam.scene.statics.stages);
    const bool                     has_days = has(stages, StaticStage::Kind::day),
               has_lifts = has(stages, StaticStage::Kind::grout);
    const std::string entry = "Entry \"Statics/Stages\"";
    if (has_days && dam.scene.loads.temperature.table.empty())
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
    if (has_lifts && dam.tied)
      throw InputError(entry + " grouts joints, but all joints are tied. Set another "
                               "\"Joints/Model\", or remove the lifts.");
    Scene at = dam.scene;         // the input file at a stage
    at.reservoir.level = endless; // empty: the water level is at the lower end of the face
    for (unsigned int i = 0; i < dam.model->n_nodes(); ++i)
      if (dam.model->on_surface(i, PhysicalId::upstream))
        at.reservoir.level = std::min(at.reservoir.level, dam.model->points[i][2]);
    if (has_days) // no temperature load before the first day
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
        check_level(at.reservoir.level = stage.value);
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
    part.cut = dam.joints_named(stage.joint, entry);
    part.width = stage.value;
    for (const std::size_t j : part.cut)
      if (dam.joint_models[j] == "tied")
        throw InputError(entry + dam.joints[j].name() +
                         ", but this joint is tied. Set another model (\"Joints/Model\" or "
                         "\"Joints/Overrides\"), or remove the cut.");
  }

  StaticPart &StaticPath::add_part(const std::string &name, const Scene &at, const double grouted)
  {
    StaticPart part{name, at.reservoir.level, grouted,
                    Unknowns(3 * std::size_t(dam.structure.n_nodes()), 0.)};
    for (const StaticLoad &load : static_loads(at, {*dam.model, dam.structure, dam.sustained}))
      for (std::size_t i = 0; load.is_raised && i < part.raised.size(); ++i)
        part.raised[i] += load.force[i];
    parts.push_back(std::move(part));
    return parts.back();
  }

  void StaticPath::check_level(const double level) const
  {
    double top = -endless;
    for (unsigned int i = 0; i < dam.model->n_nodes(); ++i)
      if (dam.model->on_surface(i, PhysicalId::upstream))
        top = std::max(top, dam.model->points[i][2]);
    std::ostringstream text;
    text << std::setprecision(8) << "Entry \"Statics/Stages\": the level " << level
         << " m is above the dam, whose top is at " << top << " m. Reduce the level.";
    if (level > top + 1e-6 * dam.size)
      throw InputError(text.str());
  }

  double StaticPath::grouted_before(const unsigned int step) const
  {
    return step == 0 ? grouted_at_start : part(step - 1).grouted;
  }

  double StaticPath::share(const unsigned int step) const
  {
    return double(step % increments + 1) / increments;
  }

  Unknowns StaticPath::load(const unsigned int step) const
  {
    const double    share = this->share(step);
    const Unknowns &to = part(step).raised;
    Unknowns        sum(to.size());
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] = share * to[i];
    if (step >= increments)
    {
      const Unknowns &from = part(step - increments).raised;
      for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += (1. - share) * from[i];
    }
    for (const StaticLoad &load : dam.loads)
      for (std::size_t i = 0; !load.is_raised && i < sum.size(); ++i)
        sum[i] += load.force[i];
    for (std::size_t p = 0; p < dam.structure.pairs.size(); ++p)
      if (const double pressure = grout_pressure(step, p); pressure > 0.)
        dam.structure.add_pair_force(dam.structure.pairs[p],
                                     {{pressure * dam.structure.pairs[p].area, 0., 0.}}, sum);
    return sum;
  }

  double StaticPath::water_pressure(const unsigned int step, const double z) const
  {
    const auto   depth = [&](const StaticPart &part) { return std::max(0., part.level - z); };
    const double share = this->share(step), before = step < increments ? 0. : depth(part(step - increments));
    return dam.scene.reservoir.density * dam.scene.statics.gravity * dam.scene.loads.factor("water") *
           (share * depth(part(step)) + (1. - share) * before);
  }

  double StaticPath::grout_pressure(const unsigned int step, const std::size_t pair) const
  {
    const double z = dam.structure.pairs[pair].place[2];
    const bool   is_fluid = z > part(step).grouted && z <= part(step).fluid_to &&
                          !dam.is_cast(dam.structure.pairs[pair]) && !dam.is_tied(pair);
    return is_fluid ? share(step) * part(step).pressure : 0.;
  }

  double StaticPath::cut_width(const unsigned int step, const std::size_t joint) const
  {
    const std::vector<std::size_t> &cut = part(step).cut;
    return std::find(cut.begin(), cut.end(), joint) == cut.end() ? 0. : part(step).width / increments;
  }

  PairLaws laws_up_to(const double grouted, const Dam &dam, const PairLaws &ungrouted)
  {
    PairLaws laws = dam.laws;
    for (std::size_t p = 0; p < laws.of_pair.size(); ++p)
      if (const Pair &pair = dam.structure.pairs[p];
          pair.place[2] > grouted && !dam.is_cast(pair) && !dam.is_tied(p))
        laws.of_pair[p] = ungrouted.of_pair[p];
    return laws;
  }
} // namespace Voussoir
