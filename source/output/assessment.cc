// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/output/assessment.h>
#include <voussoir/solid/face_quads.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace Voussoir
{
  namespace
  {
    constexpr std::array<std::pair<int, const char *>, 2> faces = {
        {{PhysicalId::upstream, "upstream"}, {PhysicalId::downstream, "downstream"}}};

    using Levels = Overstress::Levels;

    /** Demand-capacity ratios and overstress of one face. */
    struct Demand
    {
      double ratio = 0.; ///< largest demand-capacity ratio [-]
      Levels duration{}; ///< longest duration above each level at a node [s]
      Levels share{};    ///< share of the face that exceeds each level [-]
      double area = 0.;  ///< sum of the nodal areas [m^2]
    };

    /** Returns the values of one face. @p maximum: largest stress of each node over time [Pa]. @p near_base: nodes near
     * the base are included. */
    Demand demand_on(const SolidModel &model, const int surface, const StressesOfRun &stresses,
                     const std::vector<float> &maximum, const double strength, const bool near_base)
    {
      Demand                  demand;
      const EnvelopeRecorder &envelope = stresses.envelope;
      for (const FaceQuad &quad : face_quads(model, surface))
      {
        const double part = area(model, quad) / 4.;
        for (const unsigned int node : quad.nodes)
        {
          if (!near_base && stresses.tension.is_near_base(node))
            continue;
          const double ratio = maximum[node] / strength;
          demand.area += part;
          demand.ratio = std::max(demand.ratio, ratio);
          for (unsigned int k = 0; k < Overstress::n_levels; ++k)
          {
            demand.duration[k] = std::max(demand.duration[k], envelope.overstress.duration(node, k));
            demand.share[k] += ratio > Overstress::level(k) ? part : 0.;
          }
        }
      }
      for (double &share : demand.share)
        share /= std::max(demand.area, 1e-300);
      return demand;
    }

    /** Replaces the values of @p worst by larger ones of @p demand. */
    void take_worst(Demand &worst, const Demand &demand)
    {
      worst.ratio = std::max(worst.ratio, demand.ratio);
      for (unsigned int k = 0; k < Overstress::n_levels; ++k)
      {
        worst.duration[k] = std::max(worst.duration[k], demand.duration[k]);
        worst.share[k] = std::max(worst.share[k], demand.share[k]);
      }
    }

    std::string nothing_away(const std::string &name)
    {
      return "no node of the surface '" + name + "' is farther from the base than a tenth of the height";
    }

    std::string no_face(const std::string &name)
    {
      return "the mesh has no surface '" + name + "'";
    }
  } // namespace

  Json json_of(const Extreme &extreme)
  {
    Json json;
    json.add("value", extreme.value).add_list("place", extreme.place).add("time", extreme.time);
    return json;
  }

  Assessment::Assessment(const LimitParameters &limits, const SolidModel &model,
                         const StressesOfRun *stresses, const JointRecorder *joints,
                         const BlockObserver *blocks, const std::optional<double> wedge_safety)
      : limits(limits)
  {
    const std::string no_stress = "Output/Envelope interval is 0", no_joint = "no joint can move";
    if (stresses == nullptr)
      leave_stresses(no_stress);
    else if (stresses->interval > 1)
      leave_stresses("Output/Envelope interval is " + std::to_string(stresses->interval) +
                     ", so that peaks between are missed");
    else
      add_stresses(model, *stresses);
    if (stresses != nullptr && stresses->envelope.overstress.is_active())
      add_demand(model, *stresses);
    else
      leave_demand(stresses == nullptr ? no_stress : "there is no Limits/Static tensile strength");
    if (joints != nullptr)
      add_joints(*joints);
    else
      for (const auto &[name, limit] : {std::make_pair("opening", limits.opening),
                                        {"slip", limits.slip},
                                        {"waterstop_opening", limits.waterstop_opening},
                                        {"waterstop_slip", limits.waterstop_slip},
                                        {"key_shear_stress", limits.key_shear_stress}})
        leave(name, limit, no_joint);
    add_blocks(blocks);
    if (!wedge_safety)
      leave("wedge_safety", limits.wedge_safety, "there is no Limits/Wedges");
    else if (limits.wedge_safety > 0.)
      verdicts.push_back({"wedge_safety", "", *wedge_safety, limits.wedge_safety, true});
  }

  void Assessment::leave_stresses(const std::string &reason)
  {
    leave("tension", limits.tension, reason);
    leave("compression", limits.compression, reason);
  }

  void Assessment::leave_demand(const std::string &reason)
  {
    leave("demand_capacity", limits.demand_capacity, reason);
    leave("overstressed_share", limits.overstress_share, reason);
    leave("overstress_duration", limits.overstress_seconds, reason);
  }

  void Assessment::leave(const std::string &name, const double limit, const std::string &reason)
  {
    if (limit > 0.)
      unevaluated.emplace_back(name, reason);
  }

  void Assessment::hold(const std::string &name, const std::string &unit, const double value,
                        const double limit, const std::optional<double> with_base)
  {
    if (limit > 0.)
      verdicts.push_back({name, unit, value, limit, false, with_base});
  }

  void Assessment::add_stresses(const SolidModel &model, const StressesOfRun &stresses)
  {
    const EnvelopeRecorder &envelope = stresses.envelope;
    for (const auto &[surface, face] : faces)
    {
      const std::string name = std::string("tension_") + face;
      const double      away = stresses.tension.largest_away_from_base(envelope, model, surface).value;
      if (face_quads(model, surface).empty())
        leave(name, limits.tension, no_face(face));
      else if (!std::isfinite(away))
        leave(name, limits.tension, nothing_away(face));
      else
        hold(name, "Pa", away, limits.tension, envelope.extreme(model, surface, true).value);
    }
    const double away = stresses.tension.smallest_away_from_base(envelope, model).value;
    if (std::isfinite(away))
      hold("compression", "Pa", -away, limits.compression, -envelope.extreme(model, 0, false).value);
    else
      leave("compression", limits.compression,
            "no node of the dam is farther from the base than a tenth of the height");
  }

  void Assessment::add_demand(const SolidModel &model, const StressesOfRun &stresses)
  {
    Demand worst, with_base;
    Levels levels;
    for (unsigned int k = 0; k < Overstress::n_levels; ++k)
      levels[k] = Overstress::level(k);
    overstress.emplace();
    overstress->add("static_tensile_strength", limits.static_strength()).add_list("levels", levels);
    std::string without;
    for (const auto &[surface, name] : faces)
    {
      const auto demand = [&, id = surface](const std::vector<float> &maximum, const bool near_base)
      { return demand_on(model, id, stresses, maximum, limits.static_strength(), near_base); };
      const Demand all = demand(stresses.envelope.maximum, true),
                   away = demand(stresses.envelope.maximum, false);
      if (all.area == 0. || away.area == 0.) // then the largest value is unknown
        without = all.area == 0. ? no_face(name) : nothing_away(name);
      if (all.area == 0.)
        continue;
      Json of_face;
      of_face.add("demand_capacity_away_from_base", away.ratio)
          .add_list("duration_away_from_base", away.duration)
          .add_list("share_away_from_base", away.share)
          .add("demand_capacity", all.ratio)
          .add_list("duration", all.duration)
          .add_list("share", all.share);
      for (unsigned int k = 0; k < 2; ++k) // arch and cantilever
      {
        const Demand of_direction = demand(stresses.envelope.faces.field(model.n_nodes(), k, true), false);
        const std::string direction = FaceDirections::name(k);
        of_face.add("demand_capacity_" + direction + "_away_from_base", of_direction.ratio)
            .add_list("share_" + direction + "_away_from_base", of_direction.share);
      }
      overstress->add(name, of_face);
      take_worst(worst, away);
      take_worst(with_base, all);
    }
    if (stresses.interval > 1)
      without = "Output/Envelope interval is " + std::to_string(stresses.interval) +
                ", so that peaks between are missed";
    longest = worst.duration[0];
    if (!without.empty())
      return leave_demand(without);
    hold("demand_capacity", "", worst.ratio, limits.demand_capacity, with_base.ratio);
    hold_by_level("overstressed_share", "", worst.share, with_base.share, limits.overstress_share);
    if (!stresses.envelope.overstress.has_lasted())
      leave("overstress_duration", limits.overstress_seconds, "the stresses are recorded at one time only");
    else
      hold_by_level("overstress_duration", "s", worst.duration, with_base.duration,
                    limits.overstress_seconds);
  }

  /** Compares the values of all levels with a limit that falls linearly to zero at twice the strength. The verdict has
   * the level with the largest excess. */
  void Assessment::hold_by_level(const std::string &name, const std::string &unit, const Levels &worst,
                                 const Levels &with_base, const double limit)
  {
    if (!(limit > 0.))
      return;
    Verdict verdict{name, unit, worst[0], limit, false, with_base[0]};
    for (unsigned int k = 1; k < Overstress::n_levels; ++k)
    {
      const double allowed = std::max(0., limit * (2. - Overstress::level(k)));
      if (worst[k] - allowed > std::max(0., verdict.value - verdict.limit))
        verdict.value = worst[k], verdict.limit = allowed, verdict.with_base = with_base[k];
    }
    verdicts.push_back(verdict);
  }

  void Assessment::add_joints(const JointRecorder &joints)
  {
    const JointPoints &points = joints.points;
    residual.emplace();
    std::vector<double> openings, slips; // of the joints
    for (const JointPoints::Residual &of_joint : points.residuals())
    {
      openings.push_back(of_joint.opening);
      slips.push_back(of_joint.slip);
    }
    residual->add("max_opening", json_of(points.residual(false)))
        .add("max_slip", json_of(points.residual(true)))
        .add_list("openings", openings)
        .add_list("slips", slips);
    hold("opening", "m", joints.opening.value, limits.opening);
    hold("slip", "m", joints.slip.value, limits.slip);
    add_keys(joints.keys);
    if (!points.has_waterstops())
    {
      const std::string reason = "every joint is thinner than Limits/Waterstop depth";
      leave("waterstop_opening", limits.waterstop_opening, reason);
      leave("waterstop_slip", limits.waterstop_slip, reason);
      return;
    }
    waterstop.emplace();
    waterstop->add("depth", limits.waterstop_depth)
        .add("max_opening", json_of(points.waterstop_opening))
        .add("max_slip", json_of(points.waterstop_slip));
    hold("waterstop_opening", "m", points.waterstop_opening.value, limits.waterstop_opening);
    hold("waterstop_slip", "m", points.waterstop_slip.value, limits.waterstop_slip);
  }

  void Assessment::add_blocks(const BlockObserver *blocks)
  {
    if (blocks == nullptr)
      leave("sliding_safety", limits.sliding_safety, "Output/Block forces is false");
    else if (!blocks->has_safety())
      leave("sliding_safety", limits.sliding_safety, "Limits/Base friction and Limits/Base cohesion are 0");
    else if (limits.sliding_safety > 0.)
      verdicts.push_back({"sliding_safety", "", blocks->least_safety().value, limits.sliding_safety, true});
  }

  void Assessment::add_keys(const KeyForces &of_joints)
  {
    if (of_joints.joints.empty())
      return leave("key_shear_stress", limits.key_shear_stress, "no joint has the model KSM");
    const KeyForces::OfJoint &worst = of_joints.worst();
    Json                      stress;
    std::vector<double>       numbers, forces;
    for (const KeyForces::OfJoint &one : of_joints.joints)
    {
      numbers.push_back(one.joint + 1);
      forces.push_back(one.force);
    }
    stress.add("value", worst.stress()).add("joint", worst.joint + 1).add("time", worst.time);
    keys.emplace();
    keys->add("max_shear_stress", stress).add_list("joints", numbers).add_list("force", forces);
    hold("key_shear_stress", "Pa", worst.stress(), limits.key_shear_stress);
  }

  void Assessment::add_to(Json &summary) const
  {
    if (overstress)
      summary.add("overstress", *overstress);
    if (waterstop)
      summary.add("waterstop", *waterstop);
    if (residual)
      summary.add("residual", *residual);
    if (keys)
      summary.add("keys", *keys);
    Json open;
    for (const auto &[name, reason] : unevaluated)
      open.add(name, reason);
    if (!unevaluated.empty())
      summary.add("limits_not_evaluated", open).add("limits_not_judged", open); // the latter for one release
    if (verdicts.empty())
      return;
    Json all;
    for (const Verdict &verdict : verdicts)
    {
      Json one;
      one.add("value", verdict.value)
          .add("limit", verdict.limit)
          .add("unit", verdict.unit)
          .add_flag("satisfied", verdict.satisfied())
          .add_flag("kept", verdict.satisfied()); // for one release
      if (verdict.with_base)
        one.add("value_with_base", *verdict.with_base);
      if (verdict.is_least)
        one.add_flag("is_least", true);
      all.add(verdict.name, one);
    }
    summary.add("limits", all);
  }

  namespace
  {
    /** Returns a text such as "tension upstream 3.1 MPa (limit 2 MPa; 4.5 MPa with the base)". */
    std::string sentence(const Verdict &verdict)
    {
      std::string name = verdict.name;
      std::replace(name.begin(), name.end(), '_', ' ');
      const bool        stress = verdict.unit == "Pa", length = verdict.unit == "m";
      const double      scale = stress ? 1e-6 : length ? 1e3 : 1.;
      const std::string unit = stress                 ? " MPa"
                               : length               ? " mm"
                               : verdict.unit.empty() ? ""
                                                      : " " + verdict.unit;
      char              text[160], more[60] = "";
      if (verdict.with_base)
        std::snprintf(more, sizeof(more), "; %.3g%s with the base", scale * *verdict.with_base, unit.c_str());
      std::snprintf(text, sizeof(text), "%s %.3g%s (%s %.3g%s%s)", name.c_str(), scale * verdict.value,
                    unit.c_str(), verdict.is_least ? "required" : "limit", scale * verdict.limit,
                    unit.c_str(), more);
      return text;
    }
  } // namespace

  std::string Assessment::in_words() const
  {
    std::string exceeded;
    for (const Verdict &verdict : verdicts)
      if (!verdict.satisfied())
        exceeded += (exceeded.empty() ? "exceeded: " : ", ") + sentence(verdict);
    std::string text = verdicts.empty()      ? ""
                       : !exceeded.empty()   ? exceeded
                       : unevaluated.empty() ? "all are satisfied"
                                             : "the others are satisfied";
    for (const auto &[name, reason] : unevaluated)
    {
      text += (text.empty() ? "not evaluated: " : "; not evaluated: ") + name + " (" + reason + ")";
      std::replace(text.end() - name.size() - reason.size() - 3, text.end() - reason.size() - 3, '_', ' ');
    }
    return text;
  }
} // namespace Voussoir
