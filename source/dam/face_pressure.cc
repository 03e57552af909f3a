// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/dam/face_pressure.h>
#include <voussoir/solid/for_faces.h>

#include <algorithm>

namespace Voussoir
{
  using namespace dealii;

  namespace
  {
    Vector3 scaled(const double factor, const Vector3 &v)
    {
      return {{factor * v[0], factor * v[1], factor * v[2]}};
    }

    /** Pressure of water with this surface [m] and unit weight [N/m^3]. */
    Vector3 of_water(const double level, const double weight, const double z, const Vector3 &normal)
    {
      return scaled(-weight * std::max(0., level - z), normal);
    }

    Vector3 of_silt(const SiltParameters &silt, const double gravity, const double z, const Vector3 &normal)
    {
      const double vertical = silt.density * gravity * std::max(0., silt.level - z),
                   lateral = -vertical * silt.pressure_coefficient();
      return {{lateral * normal[0], lateral * normal[1], -vertical * std::max(0., normal[2])}};
    }

    /** Forces of traction(z, normal) on the faces of a surface [N]: with 8 x 8 points per face, since levels
     * cut through faces. */
    template <class Traction>
    void add_traction(const SolidModel &model, const int surface, const Traction &traction, Unknowns &load)
    {
      for_faces(model, surface, 8,
                [&](const FEFaceValues<3> &values, const auto &dofs)
                {
                  for (const unsigned int q : values.quadrature_point_indices())
                  {
                    const Tensor<1, 3> n = values.normal_vector(q);
                    const Vector3      t = traction(values.quadrature_point(q)[2], {{n[0], n[1], n[2]}});
                    for (unsigned int i = 0; i < dofs.size(); ++i)
                      if (const unsigned int e = model.equation[dofs[i]]; e != rigid_ground)
                        for (unsigned int c = 0; c < 3; ++c)
                          load[3 * std::size_t(e) + c] += t[c] * values.shape_value(i, q) * values.JxW(q);
                  }
                });
    }
  } // namespace

  KnownTraction known_traction(const Scene &scene)
  {
    const double gravity = scene.statics.gravity;
    const auto  &loads = scene.loads;
    const double water = loads.factor("water") * scene.reservoir.density * gravity,
                 tail = loads.factor("tail water") * loads.tail_water.density * gravity,
                 silt = loads.factor("silt"), level = scene.reservoir.level;
    return [=](const int surface, const double z, const Vector3 &normal)
    {
      Vector3 t{};
      if (surface == PhysicalId::upstream)
      {
        add(t, of_water(level, water, z, normal));
        add(t, scaled(silt, of_silt(loads.silt, gravity, z, normal)));
      }
      if (surface == PhysicalId::downstream)
        add(t, of_water(loads.tail_water.level, tail, z, normal));
      return t;
    };
  }

  void add_tail_water(const SolidModel &model, const TailWaterParameters &water, const double gravity,
                      Unknowns &load)
  {
    add_traction(
        model, PhysicalId::downstream,
        [&](const double z, const Vector3 &normal)
        { return of_water(water.level, water.density * gravity, z, normal); },
        load);
  }

  void add_silt(const SolidModel &model, const SiltParameters &silt, const double gravity, Unknowns &load)
  {
    add_traction(
        model, PhysicalId::upstream,
        [&](const double z, const Vector3 &normal) { return of_silt(silt, gravity, z, normal); }, load);
  }
} // namespace Voussoir
