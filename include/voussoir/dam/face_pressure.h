// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_face_pressure_h
#define voussoir_face_pressure_h

#include <voussoir/dam/scene.h>
#include <voussoir/solid/solid_model.h>

#include <functional>

namespace Voussoir
{
  /** Adds the nodal forces [N] of a traction [Pa] on the faces of a surface. Each face has 8 x 8 quadrature
   * points, because a level may cut through a face. Returns the resultant on fixed nodes [N]. */
  Vector3 add_traction(const SolidModel &model, int surface,
                       const std::function<Vector3(double z, const Vector3 &normal)> &traction,
                       Unknowns                                                      &load);

  // Tractions of loads times a factor [Pa]. A horizontal line load q [N/m], such as ice, is -(q/h) (n_x, n_y, 0) over a
  // height h of whole elements; otherwise the quadrature gives a wrong resultant.
  // @p z: height of the point [m]; @p normal: outward normal.

  /** Returns the hydrostatic pressure of the reservoir. */
  Vector3 water_traction(const Scene &scene, double factor, double z, const Vector3 &normal);

  /** Returns the hydrostatic pressure of the tail water. */
  Vector3 tail_water_traction(const Scene &scene, double factor, double z, const Vector3 &normal);

  /** Returns the traction of the sediment. At the depth h the vertical pressure is p = density gravity h and
   * the horizontal pressure K p, with K = SiltParameters::pressure_coefficient(). The horizontal pressure
   * acts on all faces, the vertical pressure only on faces with an upward normal. */
  Vector3 silt_traction(const Scene &scene, double factor, double z, const Vector3 &normal);
} // namespace Voussoir

#endif
