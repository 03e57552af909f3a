// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/rock/incident_wave.h>

#include <algorithm>

namespace Voussoir
{
  IncidentWave incident_wave(const GroundMotion &outcrop)
  {
    // Velocity and displacement at the samples; between them acceleration is linear.
    struct State
    {
      Vector3 a, v, u;
    };
    std::vector<State> states;
    const double       dt = outcrop.dt;
    State              now{};
    for (const auto &sample : outcrop.acceleration)
    {
      State next;
      for (unsigned int c = 0; c < 3; ++c)
      {
        next.a[c] = .5 * sample[c];
        const double mean = states.empty() ? 0. : .5 * dt * (now.a[c] + next.a[c]);
        const double path = states.empty() ? 0. : dt * now.v[c] + dt * dt * (now.a[c] / 3. + next.a[c] / 6.);
        next.v[c] = now.v[c] + mean;
        next.u[c] = now.u[c] + path;
      }
      states.push_back(now = next);
    }
    return [states, dt](const double t)
    {
      Vector3 u{};
      if (t <= 0. || states.empty())
        return u;
      const std::size_t k = std::min<std::size_t>(t / dt, states.size() - 1);
      const State      &s = states[k];
      const double      tau = t - k * dt;
      for (unsigned int c = 0; c < 3; ++c)
      {
        const bool   last = k + 1 == states.size(); // at rest but for its velocity from here on
        const double slope = last ? 0. : (states[k + 1].a[c] - s.a[c]) / dt;
        u[c] = s.u[c] + tau * (s.v[c] + (last ? 0. : tau * (s.a[c] / 2. + tau * slope / 6.)));
      }
      return u;
    };
  }
} // namespace Voussoir
