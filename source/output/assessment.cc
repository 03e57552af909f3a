// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/output/assessment.h>
#include <voussoir/solid/face_quads.h>

#include <algorithm>
#include <cstdio>

namespace Voussoir
{
  namespace
  {
    constexpr std::array<std::pair<int, const char *>, 2> faces = {
        {{PhysicalId::upstream, "upstream"}, {PhysicalId::downstream, "downstream"}}};

    using Levels = Overstress::Levels;

    /** Demand over capacity on one face. */
    struct Demand
    {
      double ratio = 0.; ///< the largest
      Levels duration{}; ///< the longest at a node above each level [s]
      Levels share{};    ///< of the face ever above each level
    };

    Demand demand_on(const SolidModel &model, const int surface, const EnvelopeRecorder &envelope,
                     const double strength)
    {
      Demand demand;
      double whole = 0.;
      for (const FaceQuad &quad : face_quads(model, surface))
      {
        const double part = area(model, quad) / 4.;
        for (const unsigned int node : quad.nodes)
        {
          const double ratio = envelope.maximum[node] / strength;
          whole += part;
          demand.ratio = std::max(demand.ratio, ratio);
          for (unsigned int k = 0; k < Overstress::n_levels; ++k)
          {
            demand.duration[k] = std::max(demand.duration[k], envelope.overstress.duration(node, k));
            demand.share[k] += ratio > Overstress::level(k) ? part : 0.;
          }
        }
      }
      for (double &share : demand.share)
        share /= std::max(whole, 1e-300);
      return demand;
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
                         const EnvelopeRecorder *envelope, const JointRecorder *joints,
                         const BlockRecorder *blocks)
      : limits(limits)
  {
    const std::string no_stress = "Output/Envelope interval is 0", no_joint = "no joint can move";
    if (envelope != nullptr)
      add_stresses(model, *envelope);
    else
    {
      leave("tension", limits.tension, no_stress);
      leave("compression", limits.compression, no_stress);
    }
    if (envelope != nullptr && envelope->overstress.watches())
      add_demand(model, *envelope);
    else
      for (const auto &[name, limit] : {std::make_pair("demand_capacity", limits.demand_capacity),
                                        {"overstressed_share", limits.overstress_share},
                                        {"overstress_duration", limits.overstress_seconds}})
        leave(name, limit, envelope == nullptr ? no_stress : "there is no Limits/Tensile strength");
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
  }

  void Assessment::leave(const std::string &name, const double limit, const std::string &reason)
  {
    if (limit > 0.)
      unjudged.emplace_back(name, reason);
  }

  void Assessment::hold(const std::string &name, const std::string &unit, const double value,
                        const double limit)
  {
    if (limit > 0.)
      verdicts.push_back({name, unit, value, limit});
  }

  void Assessment::add_stresses(const SolidModel &model, const EnvelopeRecorder &envelope)
  {
    for (const auto &[surface, name] : faces)
      if (face_quads(model, surface).empty())
        leave(std::string("tension_") + name, limits.tension, no_face(name));
      else
        hold(std::string("tension_") + name, "Pa", envelope.extreme(model, surface, true).value,
             limits.tension);
    hold("compression", "Pa", -envelope.extreme(model, 0, false).value, limits.compression);
  }

  void Assessment::add_demand(const SolidModel &model, const EnvelopeRecorder &envelope)
  {
    Demand worst;
    Levels levels;
    for (unsigned int k = 0; k < Overstress::n_levels; ++k)
      levels[k] = Overstress::level(k);
    overstress.emplace();
    overstress->add("tensile_strength", limits.tensile_strength).add_list("levels", levels);
    std::string without;
    for (const auto &[surface, name] : faces)
    {
      if (face_quads(model, surface).empty())
      {
        without = no_face(name);
        continue;
      }
      const Demand demand = demand_on(model, surface, envelope, limits.tensile_strength);
      Json         of_face;
      of_face.add("demand_capacity", demand.ratio)
          .add_list("duration", demand.duration)
          .add_list("share", demand.share);
      overstress->add(name, of_face);
      worst.ratio = std::max(worst.ratio, demand.ratio);
      for (unsigned int k = 0; k < Overstress::n_levels; ++k)
      {
        worst.duration[k] = std::max(worst.duration[k], demand.duration[k]);
        worst.share[k] = std::max(worst.share[k], demand.share[k]);
      }
    }
    if (!without.empty()) // the other one may be the worse
    {
      leave("demand_capacity", limits.demand_capacity, without);
      leave("overstressed_share", limits.overstress_share, without);
      return leave("overstress_duration", limits.overstress_seconds, without);
    }
    hold("demand_capacity", "", worst.ratio, limits.demand_capacity);
    hold("overstressed_share", "", worst.share[0], limits.overstress_share);
    if (!envelope.overstress.has_lasted())
      leave("overstress_duration", limits.overstress_seconds, "the stresses are of one time only");
    else
      add_duration(worst.duration);
  }

  void Assessment::add_duration(const Overstress::Levels &worst)
  {
    if (!(limits.overstress_seconds > 0.))
      return;
    // The level at which the duration is farthest above what is allowed there.
    Verdict verdict{"overstress_duration", "s", worst[0], limits.overstress_seconds};
    for (unsigned int k = 1; k < Overstress::n_levels; ++k)
    {
      const double allowed = std::max(0., limits.overstress_seconds * (2. - Overstress::level(k)));
      if (worst[k] - allowed > std::max(0., verdict.value - verdict.limit))
        verdict.value = worst[k], verdict.limit = allowed;
    }
    verdicts.push_back(verdict);
  }

  void Assessment::add_joints(const JointRecorder &joints)
  {
    const JointPoints &points = joints.points;
    residual.emplace();
    residual->add("max_opening", json_of(points.residual(false)))
        .add("max_slip", json_of(points.residual(true)));
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

  void Assessment::add_blocks(const BlockRecorder *blocks)
  {
    if (blocks == nullptr)
      leave("sliding_safety", limits.sliding_safety, "Output/Block forces is false");
    else if (!blocks->has_safety())
      leave("sliding_safety", limits.sliding_safety,
            "there is neither Limits/Base friction nor Limits/Base cohesion");
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
    for (const auto &[name, reason] : unjudged)
      open.add(name, reason);
    if (!unjudged.empty())
      summary.add("limits_not_judged", open);
    if (verdicts.empty())
      return;
    Json all;
    for (const Verdict &verdict : verdicts)
    {
      Json one;
      one.add("value", verdict.value)
          .add("limit", verdict.limit)
          .add("unit", verdict.unit)
          .add_flag("kept", verdict.kept());
      if (verdict.is_least)
        one.add_flag("is_least", true);
      all.add(verdict.name, one);
    }
    summary.add("limits", all);
  }

  std::string Assessment::in_words() const
  {
    std::string exceeded;
    for (const Verdict &verdict : verdicts)
    {
      std::string name = verdict.name;
      std::replace(name.begin(), name.end(), '_', ' ');
      const bool   stress = verdict.unit == "Pa", length = verdict.unit == "m";
      const double scale = stress ? 1e-6 : length ? 1e3 : 1.;
      char         text[120];
      std::snprintf(text, sizeof(text), "%s %.3g %s %.3g%s%s", name.c_str(), scale * verdict.value,
                    verdict.is_least ? "instead of" : "of", scale * verdict.limit,
                    verdict.unit.empty() ? "" : " ",
                    stress   ? "MPa"
                    : length ? "mm"
                             : verdict.unit.c_str());
      if (!verdict.kept())
        exceeded += (exceeded.empty() ? "exceeded: " : ", ") + std::string(text);
    }
    std::string text = verdicts.empty()    ? ""
                       : !exceeded.empty() ? exceeded
                       : unjudged.empty()  ? "all are kept"
                                           : "the others are kept";
    for (const auto &[name, reason] : unjudged)
    {
      text += (text.empty() ? "not judged: " : "; not judged: ") + name + " (" + reason + ")";
      std::replace(text.end() - name.size() - reason.size() - 3, text.end() - reason.size() - 3, '_', ' ');
    }
    return text;
  }
} // namespace Voussoir
