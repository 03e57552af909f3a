// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_incident_wave_h
#define voussoir_incident_wave_h

#include <voussoir/base/tensor3.h>
#include <voussoir/motion/ground_motion.h>

#include <functional>

namespace Voussoir
{
  /** Displacement of the vertically rising wave as a function of time [s]: S waves in x and y, P wave in z
   * [m]. It belongs to the depth at which the wave enters: one cell below the lowest node of all columns. */
  using IncidentWave = std::function<Vector3(double)>;

  /** Returns half the displacement of the free-surface motion @p outcrop: the exact integral of its piecewise
   * linear acceleration, from rest. */
  IncidentWave incident_wave(const GroundMotion &outcrop);
} // namespace Voussoir

#endif
