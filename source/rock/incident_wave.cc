// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/rock/incident_wave.h>

#include <algorithm>

namespace Voussoir
{
  IncidentWave incident_wave(const GroundMotion &outcrop)
  {
    const GroundMotion    wave = outcrop.scaled(.5);
    const MotionIntegrals integrals = wave.integrated();
    return [wave, integrals](const double t)
    {
      const auto &a = wave.acceleration;
      Vector3     u{};
      if (t <= 0. || a.empty())
        return u;
      const std::size_t k = std::min<std::size_t>(t / wave.dt, a.size() - 1);
      const double      tau = t - k * wave.dt;
      for (unsigned int c = 0; c < 3; ++c)
      {
        const bool   last = k + 1 == a.size(); // at rest except for its velocity from here on
        const double slope = last ? 0. : (a[k + 1][c] - a[k][c]) / wave.dt;
        u[c] = integrals.displacement[k][c] +
               tau * (integrals.velocity[k][c] + (last ? 0. : tau * (a[k][c] / 2. + tau * slope / 6.)));
      }
      return u;
    };
  }
} // namespace Voussoir
