// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/entries.h>
#include <voussoir/dam/face_pressure.h>
#include <voussoir/solid/for_faces.h>

#include <algorithm>

namespace Voussoir
{
  using namespace dealii;

  namespace
  {
    /** Pressure of water with this surface [m] and unit weight [N/m^3]. */
    Vector3 of_water(const double level, const double weight, const double z, const Vector3 &normal)
    {
      return scaled(-weight * std::max(0., level - z), normal);
    }
  } // namespace

  Vector3 add_traction(const SolidModel &model, const int surface,
                       const std::function<Vector3(double z, const Vector3 &normal)> &traction,
                       Unknowns                                                      &load)
  {
    Vector3 on_fixed{};
    for_faces(model, surface, 8,
              [&](const FEFaceValues<3> &values, const auto &dofs)
              {
                for (const unsigned int q : values.quadrature_point_indices())
                {
                  const Tensor<1, 3> n = values.normal_vector(q);
                  const Vector3      t = traction(values.quadrature_point(q)[2], {{n[0], n[1], n[2]}});
                  for (unsigned int i = 0; i < dofs.size(); ++i)
                    for (unsigned int c = 0; c < 3; ++c)
                    {
                      const unsigned int e = model.equation[dofs[i]];
                      (e == rigid_ground ? on_fixed[c] : load[3 * std::size_t(e) + c]) +=
                          t[c] * values.shape_value(i, q) * values.JxW(q);
                    }
                }
              });
    return on_fixed;
  }

  Vector3 water_traction(const Scene &scene, const double factor, const double z, const Vector3 &normal)
  {
    return of_water(scene.reservoir.level, factor * scene.reservoir.density * scene.statics.gravity, z,
                    normal);
  }

  Vector3 tail_water_traction(const Scene &scene, const double factor, const double z, const Vector3 &normal)
  {
    const TailWaterParameters &water = scene.loads.tail_water;
    return of_water(water.level, factor * water.density * scene.statics.gravity, z, normal);
  }

  Vector3 silt_traction(const Scene &scene, const double factor, const double z, const Vector3 &normal)
  {
    const SiltParameters &silt = scene.loads.silt;
    const double          vertical = silt.density * scene.statics.gravity * std::max(0., silt.level - z),
                 lateral = -vertical * silt.pressure_coefficient();
    return scaled(factor, {{lateral * normal[0], lateral * normal[1], -vertical * std::max(0., normal[2])}});
  }

  void TailWaterParameters::add_parameters(Entries &prm)
  {
    prm.enter_subsection("Tail water");
    prm.add_parameter("Level", level, "Height z of the tail water surface [m]. -10000: no tail water.");
    prm.add_parameter("Density", density, "Density of the tail water [kg/m^3].", {900., 1300., true},
                      Patterns::Double(0.));
    prm.leave_subsection();
  }

  void SiltParameters::add_parameters(Entries &prm)
  {
    prm.enter_subsection("Silt");
    prm.add_parameter("Level", level, "Height z of the sediment surface upstream [m]. -10000: no sediment.");
    prm.add_parameter(
        "Density", density,
        "Submerged density of the sediment: its density minus that of the water [kg/m^3]. A unit "
        "weight in kN/m^3 is also valid.",
        {300., 1300., true}, Patterns::Double(0.));
    prm.add_parameter(
        "Friction angle", friction_angle,
        "Friction angle phi of the sediment [degrees]. The lateral pressure is (1 - sin phi)/(1 + "
        "sin phi) of the vertical pressure (Rankine's active pressure).",
        {10., 45.}, Patterns::Double(0., 89.));
    prm.add_parameter(
        "Coefficient", coefficient,
        "Ratio of lateral to vertical pressure of the sediment [-]. -1: from \"Friction angle\".", {.2, 1.},
        Patterns::Double(-1., 10.));
    prm.leave_subsection();
  }
} // namespace Voussoir
