// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/parameter_handler.h>

#include <voussoir/dam/limits.h>

namespace Voussoir
{
  void LimitParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    const dealii::Patterns::Double not_negative(0.);
    prm.enter_subsection("Limits");
    prm.add_parameter("Tensile strength", tensile_strength,
                      "Dynamic tensile strength of the concrete [Pa], reference of the demand-capacity "
                      "ratio, the duration and the share of overstress. 0: none. Stress limits exclude nodes "
                      "that are nearer to the base than a tenth of the dam's height.",
                      not_negative);
    prm.add_parameter(
        "Demand-capacity ratio", demand_capacity,
        "Limit of the largest principal stress on the faces, divided by the tensile strength [-]. USACE EM "
        "1110-2-6053 has 2. 0: none.",
        not_negative);
    prm.add_parameter(
        "Overstress duration", overstress_seconds,
        "Limit of the cumulative duration for which the stress at a node of the faces exceeds the tensile "
        "strength [s]. It decreases linearly to zero at twice the strength. USACE EM 1110-2-6053 has 0.4 s "
        "for arch dams. 0: none.",
        not_negative);
    prm.add_parameter(
        "Overstressed share", overstress_share,
        "Limit of the share of either face where the stress exceeds the tensile strength at any time "
        "[-]. USACE EM 1110-2-6053 has 0.2. 0: none.",
        dealii::Patterns::Double(0., 1.));
    prm.add_parameter("Tension", tension,
                      "Limit of the maximum principal stress on the faces, away from the base [Pa]. 0: none.",
                      not_negative);
    prm.add_parameter("Compression", compression,
                      "Limit of the compression (magnitude), away from the base [Pa]. 0: none.",
                      not_negative);
    prm.add_parameter("Opening", opening, "Limit of the openings of the joints at all pairs [m]. 0: none.",
                      not_negative);
    prm.add_parameter("Slip", slip, "Limit of the slips of the joints at all pairs [m]. 0: none.",
                      not_negative);
    prm.add_parameter(
        "Waterstop depth", waterstop_depth,
        "Distance of the waterstops from the upstream face [m]. Openings and slips at this depth are "
        "reported.",
        not_negative);
    prm.add_parameter("Waterstop opening", waterstop_opening,
                      "Limit of the openings at the waterstops [m]. 0: none.", not_negative);
    prm.add_parameter("Waterstop slip", waterstop_slip, "Limit of the slips at the waterstops [m]. 0: none.",
                      not_negative);
    prm.add_parameter(
        "Base friction", base_friction,
        "Coefficient of friction, tan(phi), between each monolith and its foundation [-]. With friction or "
        "cohesion, blocks.csv contains the safety of each monolith against sliding on its base, (cohesion "
        "area + tan(phi) (compression - uplift)) / shear. 0 for both: it does not.",
        not_negative);
    prm.add_parameter("Base cohesion", base_cohesion,
                      "Cohesion between each monolith and its foundation [Pa].", not_negative);
    prm.add_parameter(
        "Sliding safety", sliding_safety,
        "Smallest allowed safety against sliding on the base, for every monolith at all times [-]. 0: "
        "none.",
        not_negative);
    prm.add_parameter(
        "Key shear stress", key_shear_stress,
        "Limit of the shear force of the keys of a joint, beyond the friction of its faces, divided by "
        "the area of the joint [Pa]. It is the strength of the keys times their share of the section. "
        "0: none.",
        not_negative);
    prm.leave_subsection();
  }
} // namespace Voussoir
