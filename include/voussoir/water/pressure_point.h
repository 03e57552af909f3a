// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_pressure_point_h
#define voussoir_pressure_point_h

#include <voussoir/water/water_mesh.h>

namespace Voussoir
{
  /** Point on the wet face of the dam, in the middle of the face at its depth. */
  struct PressurePoint
  {
    Vector3 place{}; ///< [m]
    std::vector<std::pair<unsigned int, double>>
        weights; ///< nodes of the water and weights, whose sum is 1 [-]

    /** Returns the interpolated value. @p values: one per node of the water at the dam. */
    double value(const std::vector<double> &values) const;
  };

  /** Returns the point at the height @p z [m]. Above or below the water of the mesh it is the highest or lowest
   * point. */
  PressurePoint pressure_point(const WaterMesh &mesh, double z);
} // namespace Voussoir

#endif
