// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_face_pressure_h
#define voussoir_face_pressure_h

#include <voussoir/dam/scene.h>
#include <voussoir/solid/solid_model.h>

#include <functional>

namespace Voussoir
{
  /** Adds the forces of a traction [Pa] on the faces of a surface [N]: with 8 x 8 points per face, since
   * levels cut through faces. */
  void add_traction(const SolidModel &model, int surface,
                    const std::function<Vector3(double z, const Vector3 &normal)> &traction, Unknowns &load);

  // Tractions of loads, times a factor, at the height z of a face whose outward normal is given [Pa].

  Vector3 water_traction(const Scene &scene, double factor, double z, const Vector3 &normal);

  Vector3 tail_water_traction(const Scene &scene, double factor, double z, const Vector3 &normal);

  /** Sediment: at the depth h its vertical pressure is p = density gravity h, its horizontal one K p. It
   * pushes with K p the horizontal part of a face, and rests with p on what looks up; under what leans over
   * it, it bears nothing. K: SiltParameters::pressure_coefficient(). */
  Vector3 silt_traction(const Scene &scene, double factor, double z, const Vector3 &normal);
} // namespace Voussoir

#endif
