// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/entries.h>
#include <voussoir/dam/limits.h>

namespace Voussoir
{
  namespace
  {
    const dealii::Patterns::Double not_negative(0.);
  }

  void LimitParameters::add_parameters(Entries &prm)
  {
    prm.enter_subsection("Limits");
    add_stresses(prm);
    add_joints_and_base(prm);
    add_wedges(prm);
    prm.leave_subsection();
  }

  void LimitParameters::add_stresses(Entries &prm)
  {
    prm.add_parameter("Tensile strength", tensile_strength,
                      "Dynamic tensile strength of the concrete [Pa]. 0: none. Stress limits exclude nodes "
                      "that are nearer to the base than a tenth of the dam's height.",
                      {1e5, 2e7, true}, not_negative);
    prm.add_parameter("Static tensile strength", static_tensile_strength,
                      "Static tensile strength of the concrete, from splitting tests [Pa], reference of the "
                      "demand-capacity ratio, the duration and the share of overstress. 0: two thirds of "
                      "\"Tensile strength\".",
                      {1e5, 1e7, true}, not_negative);
    prm.add_parameter(
        "Demand-capacity ratio", demand_capacity,
        "Limit of the largest principal stress on the faces, divided by the static tensile strength [-]. USACE EM "
        "1110-2-6053 has 2. 0: none.",
        {.2, 10., true}, not_negative);
    prm.add_parameter(
        "Overstress duration", overstress_seconds,
        "Limit of the cumulative duration for which the stress at a node of the faces exceeds the static "
        "tensile strength [s]. It decreases linearly to zero at twice the strength. USACE EM 1110-2-6053 has 0.4 s "
        "for arch dams. 0: none.",
        {.01, 10., true}, not_negative);
    prm.add_parameter(
        "Overstressed share", overstress_share,
        "Limit of the share of either face where the stress exceeds the static tensile strength at any "
        "time [-]. It decreases linearly to zero at twice the strength. USACE EM 1110-2-6053 has 0.2. 0: none.",
        dealii::Patterns::Double(0., 1.));
    prm.add_parameter("Tension", tension,
                      "Limit of the maximum principal stress on the faces, away from the base [Pa]. 0: none.",
                      {1e5, 5e7, true}, not_negative);
    prm.add_parameter("Compression", compression,
                      "Limit of the compression (magnitude), away from the base [Pa]. 0: none.",
                      {1e6, 2e8, true}, not_negative);
  }

  void LimitParameters::add_joints_and_base(Entries &prm)
  {
    prm.add_parameter("Opening", opening, "Limit of the openings of the joints at all pairs [m]. 0: none.",
                      {1e-4, .5, true}, not_negative);
    prm.add_parameter("Slip", slip, "Limit of the slips of the joints at all pairs [m]. 0: none.",
                      {1e-4, .5, true}, not_negative);
    prm.add_parameter(
        "Waterstop depth", waterstop_depth,
        "Distance of the waterstops from the upstream face [m]. Openings and slips at this depth are "
        "reported.",
        {.1, 10.}, not_negative);
    prm.add_parameter("Waterstop opening", waterstop_opening,
                      "Limit of the openings at the waterstops [m]. 0: none.", {1e-4, .5, true},
                      not_negative);
    prm.add_parameter("Waterstop slip", waterstop_slip, "Limit of the slips at the waterstops [m]. 0: none.",
                      {1e-4, .5, true}, not_negative);
    prm.add_parameter(
        "Base friction", base_friction,
        "Coefficient of friction, tan(phi), between each monolith and its foundation [-]. With friction or "
        "cohesion, blocks.csv contains the safety of each monolith against sliding on its base, (cohesion "
        "area + tan(phi) (compression - uplift)) / shear. 0 for both: it does not.",
        {.2, 2., true}, not_negative);
    prm.add_parameter("Base cohesion", base_cohesion,
                      "Cohesion between each monolith and its foundation [Pa].", {1e4, 1e7, true},
                      not_negative);
    prm.add_parameter(
        "Sliding safety", sliding_safety,
        "Smallest allowed safety against sliding on the base, for every monolith at all times [-]. 0: "
        "none.",
        {.5, 10., true}, not_negative);
    prm.add_parameter(
        "Key shear stress", key_shear_stress,
        "Limit of the shear force of the keys of a joint, beyond the friction of its faces, divided by "
        "the area of the joint [Pa]. It is the strength of the keys times their share of the section. "
        "0: none.",
        {1e4, 2e7, true}, not_negative);
  }

  void LimitParameters::add_wedges(Entries &prm)
  {
    prm.add_parameter(
        "Wedges", wedges,
        "File with the planes of rock wedges under the abutments, one line per plane (doc/base_joints.md). With it, "
        "wedges.csv contains the force of the dam on each wedge, the mode of sliding and the sliding safety over "
        "time. The path is relative to the input file.",
        dealii::Patterns::Anything());
    prm.add_parameter("Wedge safety", wedge_safety,
                      "Smallest allowed sliding safety of every rock wedge at all times [-]. 0: none.",
                      {.5, 10., true}, not_negative);
  }
} // namespace Voussoir
