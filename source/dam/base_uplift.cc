// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/entries.h>
#include <voussoir/dam/base_uplift.h>
#include <voussoir/dam/face_distance.h>
#include <voussoir/solid/for_faces.h>

#include <algorithm>

namespace Voussoir
{
  using namespace dealii;

  void UpliftParameters::add_parameters(Entries &prm)
  {
    prm.enter_subsection("Uplift");
    prm.add_parameter("Joints", joints,
                      "true: the full pressure of the reservoir acts in joints that are open at the upstream "
                      "face in the static state.");
    prm.add_parameter(
        "Base", base,
        "true: report the uplift at the base. The pressure is that of the reservoir at the heel "
        "and that of the tail water at the toe, and linear between. The uplift of a bonded base changes "
        "neither displacements nor stresses (doc/loads.md); on base joints it is a load.");
    prm.add_parameter(
        "Below closed part", below_closed_part,
        "Water pressure below the closed part of a base joint, if Joints is true. none: no pressure. "
        "linear: from the full pressure at the next pair under water, or at the heel, to that of "
        "the tail water at the toe.",
        Patterns::Selection("none|linear"));
    prm.add_parameter(
        "In earthquake", in_earthquake,
        "Water pressure in joints that the earthquake opens. unchanged: that of the static state. "
        "none in new cracks: no pressure in pairs of base joints while they are open, if they were "
        "closed in the static state. full: the pressure of the reservoir in open pairs with a "
        "connection to the upstream face through open pairs.",
        Patterns::Selection("unchanged|none in new cracks|full"));
    prm.add_parameter("Drain position", drain_position,
                      "Distance of the drains from the heel, divided by the thickness of the base [-].",
                      Patterns::Double(0., 1.));
    prm.add_parameter("Drain efficiency", drain_efficiency,
                      "Reduction of the head above the tail water at the drains, divided by this head [-].",
                      Patterns::Double(0., 1.));
    prm.leave_subsection();
  }

  double uplift_head(const double s, const double heel, const double toe, const UpliftParameters &uplift)
  {
    const double d = uplift.drain_position, rest = 1. - uplift.drain_efficiency;
    const double at_drains = toe + rest * (1. - d) * (heel - toe);
    if (s < d)
      return heel + s / d * (at_drains - heel);
    return d < 1. ? at_drains + (s - d) / (1. - d) * (toe - at_drains) : at_drains;
  }

  BaseUplift base_uplift(const Scene &scene, const SolidModel &model, const std::set<int> &closed)
  {
    const std::vector<double> place = places_in_thickness(model, "Loads/Uplift/Base", true);
    const double              factor = scene.loads.factor("uplift"), gravity = scene.statics.gravity,
                 tail = scene.loads.tail_water.level,
                 of_reservoir = scene.reservoir.density * gravity * scene.loads.factor("water"),
                 of_tail = scene.loads.tail_water.density * gravity * scene.loads.factor("tail water");
    bool       has_force = model.on_footings.empty();
    BaseUplift uplift{Unknowns(3 * std::size_t(model.n_nodes()), 0.), {}};
    const auto add_face = [&](const FEFaceValues<3> &values, const auto &dofs)
    {
      const int volume = values.get_cell()->material_id();
      for (const unsigned int q : values.quadrature_point_indices())
      {
        const double z = values.quadrature_point(q)[2];
        double       s = 0.;
        for (unsigned int i = 0; i < dofs.size(); ++i)
          s += values.shape_value(i, q) * place[dofs[i]];
        const double p = uplift_head(s, of_reservoir * std::max(0., scene.reservoir.level - z),
                                     of_tail * std::max(0., tail - z), scene.loads.uplift);
        for (unsigned int c = 0; c < 3 && !is_footing(volume); ++c)
        {
          const double f = -factor * p * values.normal_vector(q)[c] * values.JxW(q);
          uplift.of_monolith[monolith_of(volume)][c] += f;
          for (unsigned int i = 0; i < dofs.size() && has_force; ++i)
            uplift.force[3 * dofs[i] + c] += f * values.shape_value(i, q);
        }
      }
    };
    for_faces(model, PhysicalId::base, 8, add_face);
    for (const int above_footing : model.on_footings)
    {
      has_force = closed.count(above_footing) == 0;
      for_faces(model, above_footing, 8, add_face);
    }
    return uplift;
  }
} // namespace Voussoir
