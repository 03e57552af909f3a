// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/rock/free_field_column.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  unsigned int endless_length(const Vector3 &courant, const unsigned int n_steps)
  {
    // The forerunners of the front decay like those of an Airy function, over (number of cells)^(1/3).
    const double path = .5 * n_steps * *std::max_element(courant.begin(), courant.end());
    return static_cast<unsigned int>(path + 10. * std::cbrt(path)) + 50;
  }

  EndlessColumn::EndlessColumn(const Vector3 &courant, const RockDamping &damping, const double dt,
                               const unsigned int n_steps)
      : damping(damping), dt(dt), second{}
  {
    for (unsigned int c = 0; c < 3; ++c)
      ratio[c] = courant[c] * courant[c] / (dt * dt);
    // Waves of high frequency are faster in rock with a quality factor.
    Vector3 fastest = courant;
    for (double &c : fastest)
      c *= std::sqrt(relaxation_of(damping).unrelaxed);
    u.assign(3 * std::size_t(endless_length(fastest, n_steps)), 0.);
    w = x = u;
    damped = DampedMotion(damping, dt, u.size());
  }

  std::vector<std::vector<double> *> EndlessColumn::state()
  {
    auto arrays = damped.state();
    arrays.insert(arrays.begin(), {&u, &w});
    return arrays;
  }

  const Vector3 &EndlessColumn::advance(const Vector3 &first)
  {
    for (unsigned int c = 0; c < 3; ++c)
    {
      w[c] = (first[c] - u[c]) / dt;
      u[c] = first[c];
    }
    const std::size_t n = u.size();
    damped.advance(u.data(), w.data(), x.data(), 0, n);
    for (std::size_t i = 3; i + 3 < n; i += 3)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t k = i + c;
        w[k] += dt * (ratio[c] * (x[k - 3] - 2. * x[k] + x[k + 3]) - damping.mass * w[k]);
        u[k] += dt * w[k];
      }
    std::copy(u.begin() + 3, u.begin() + 6, second.begin());
    return second;
  }

  Vector3 wave_speeds(const Material &material)
  {
    const double s = s_wave_speed(material);
    return {{s, s, p_wave_speed(material)}};
  }

  namespace
  {
    Vector3 bottom_courant(const RockColumn &column, const double dt)
    {
      Vector3 courant = wave_speeds(column.material.front());
      for (double &c : courant)
        c *= dt / (column.z[1] - column.z[0]);
      return courant;
    }
  } // namespace

  FreeFieldColumn::FreeFieldColumn(const RockColumn &column, const RockDamping &damping, const double dt,
                                   const unsigned int n_steps, const IncidentWave &wave, const Vector3 &delay)
      : height(column.z), damping(damping), dt(dt), wave(wave), delay(delay),
        rising(bottom_courant(column, dt), damping, dt, n_steps),
        leaving(bottom_courant(column, dt), damping, dt, n_steps), below(12, 0.), time(1, 0.)
  {
    const std::size_t n = height.size();
    mass.assign(n, 0.);
    for (std::size_t k = 0; k + 1 < n; ++k)
    {
      const Material &m = column.material[k];
      const double    h = height[k + 1] - height[k];
      mass[k] += .5 * m.density * h;
      mass[k + 1] += .5 * m.density * h;
      for (const double c : wave_speeds(m))
        stiffness.push_back(m.density * c * c / h);
    }
    mass[0] += .5 * column.material[0].density * (height[1] - height[0]);
    std::copy(stiffness.begin(), stiffness.begin() + 3, bottom_stiffness.begin());
    u.assign(3 * (n + 1), 0.);
    w = x = u;
    damped = DampedMotion(damping, dt, 3 * n);
    damped_below = DampedMotion(damping, dt, 3);
  }

  Vector3 FreeFieldColumn::displacement(const int level, const Vector3 &, double) const
  {
    const double *at = level < 0 ? &u[u.size() - 3] : &u[3 * std::size_t(level)];
    return {{at[0], at[1], at[2]}};
  }

  Vector3 FreeFieldColumn::incident(const double t) const
  {
    Vector3 value;
    if (delay[0] == delay[2])
      return wave(t - delay[0]);
    const Vector3 s = wave(t - delay[0]), p = wave(t - delay[2]);
    value = {{s[0], s[1], p[2]}};
    return value;
  }

  void FreeFieldColumn::advance()
  {
    double *const entering = below.data(), *const at_bottom = entering + 3, *const left = entering + 6,
                  *const before = entering + 9;
    Vector3              scattered, u_below, w_below, x_below;
    for (unsigned int c = 0; c < 3; ++c)
    {
      u_below[c] = entering[c] + left[c];
      w_below[c] = (u_below[c] - before[c]) / dt;
      before[c] = u_below[c];
      scattered[c] = u[c] - at_bottom[c];
    }
    damped_below.advance(u_below.data(), w_below.data(), x_below.data(), 0, 3);
    const std::size_t n = height.size();
    damped.advance(u.data(), w.data(), x.data(), 0, 3 * n);
    for (std::size_t k = 0; k < n; ++k)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t i = 3 * k + c;
        double f = k == 0 ? bottom_stiffness[c] * (x_below[c] - x[i]) : stiffness[i - 3] * (x[i - 3] - x[i]);
        if (k + 1 < n)
          f += stiffness[i] * (x[i + 3] - x[i]);
        w[i] += dt * (f / mass[k] - damping.mass * w[i]);
        u[i] += dt * w[i];
      }
    const Vector3 &next_left = leaving.advance(scattered);
    const Vector3 &next_bottom = rising.advance({{entering[0], entering[1], entering[2]}});
    time[0] += 1.;
    const Vector3 next_entering = incident(time[0] * dt);
    for (unsigned int c = 0; c < 3; ++c)
    {
      left[c] = next_left[c];
      at_bottom[c] = next_bottom[c];
      entering[c] = next_entering[c];
      u[3 * n + c] = entering[c] + left[c];
    }
  }

  std::vector<std::vector<double> *> FreeFieldColumn::state()
  {
    std::vector<std::vector<double> *> arrays = {&u, &w, &below, &time};
    for (DampedMotion *motion : {&damped, &damped_below})
      for (auto *array : motion->state())
        arrays.push_back(array);
    for (EndlessColumn *column : {&rising, &leaving})
      for (auto *array : column->state())
        arrays.push_back(array);
    return arrays;
  }
} // namespace Voussoir
