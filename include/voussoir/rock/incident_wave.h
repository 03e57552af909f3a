// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_incident_wave_h
#define voussoir_incident_wave_h

#include <voussoir/base/tensor3.h>
#include <voussoir/motion/ground_motion.h>

#include <functional>

namespace Voussoir
{
  /** Displacement of the vertically rising wave at time t [m]: S in x and y, P in z. It is that of the depth
   * at which it enters, one cell below the lowest foot of the columns. */
  using IncidentWave = std::function<Vector3(double)>;

  /** Half the displacement that belongs to a motion of the free surface (outcrop): the exact integral of its
   * piecewise linear acceleration from rest. */
  IncidentWave incident_wave(const GroundMotion &outcrop);
} // namespace Voussoir

#endif
