// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/rock/rock_damping.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  Relaxation relaxation_of(const RockDamping &damping)
  {
    if (!damping.has_quality())
      return Relaxation();
    // Mechanisms that extend beyond the band by this factor give about the smallest error.
    Relaxation   law(damping.quality, damping.lowest, damping.highest, DampedMotion::n, 1.4);
    const double middle = 2. * M_PI * damping.lowest * std::pow(damping.highest / damping.lowest, .5);
    const double slowness = (1. / std::sqrt(law.modulus(middle))).real();
    law.unrelaxed = slowness * slowness;
    return law;
  }

  DampedMotion::DampedMotion(const RockDamping &damping, const double dt, const std::size_t n_values)
      : dt(dt), stiffness(damping.stiffness)
  {
    if (!damping.has_quality())
      return;
    const Relaxation law = relaxation_of(damping);
    unrelaxed = law.unrelaxed;
    std::copy(law.weight.begin(), law.weight.end(), weight.begin());
    for (unsigned int l = 0; l < n; ++l)
    {
      const double half = .5 * law.frequency[l] * dt;
      kept[l] = (1. - half) / (1. + half);
      added[l] = half / (1. + half);
      memory[l].assign(n_values, 0.);
    }
  }

  void DampedMotion::advance(const double *u, const double *w, double *x, const std::size_t first,
                             const std::size_t last)
  {
    const double b = stiffness;
    if (memory[0].empty())
    {
#pragma omp simd
      for (std::size_t i = first; i < last; ++i)
        x[i] = u[i] + b * w[i];
      return;
    }
    double *a0 = memory[0].data(), *a1 = memory[1].data(), *a2 = memory[2].data();
#pragma omp simd
    for (std::size_t i = first; i < last; ++i)
    {
      const double both = 2. * u[i] - dt * w[i]; // u(t) + u(t + dt)
      a0[i] = kept[0] * a0[i] + added[0] * both;
      a1[i] = kept[1] * a1[i] + added[1] * both;
      a2[i] = kept[2] * a2[i] + added[2] * both;
      x[i] = unrelaxed * (u[i] - (weight[0] * a0[i] + weight[1] * a1[i] + weight[2] * a2[i])) + b * w[i];
    }
  }

  void DampedMotion::keep_energy()
  {
    for (unsigned int l = 0; l < n; ++l)
      force[l].assign(memory[l].size(), 0.);
  }

  double DampedMotion::elastic(const double *K_x, const double *u, const double *w, double *f,
                               const std::size_t first, const std::size_t n_values)
  {
    // K_x = f - sum Y xi + ratio (f - f_before), where xi = kept xi_before + added (f_before + f)
    const double ratio = stiffness / (dt * unrelaxed);
    if (memory[0].empty())
    {
      const double share = 1. / (1. + ratio);
#pragma omp simd
      for (std::size_t i = 0; i < n_values; ++i)
        f[i] = share * (K_x[i] + ratio * f[i]);
      return 0.;
    }
    double share = 1. + ratio, of_before = ratio;
    for (unsigned int l = 0; l < n; ++l)
    {
      share -= weight[l] * added[l];
      of_before += weight[l] * added[l];
    }
    share = 1. / share;
    double *const g0 = force[0].data() + first, *g1 = force[1].data() + first, *g2 = force[2].data() + first;
    const double *const x0 = memory[0].data() + first, *x1 = memory[1].data() + first,
                        *x2 = memory[2].data() + first;
    const double y0 = weight[0], y1 = weight[1], y2 = weight[2];
    double       stored = 0.; // sum Y (xi g_before - u_before g - u g_before), g: forces of xi
#pragma omp simd reduction(+ : stored)
    for (std::size_t i = 0; i < n_values; ++i)
    {
      const double before = f[i], h0 = kept[0] * g0[i], h1 = kept[1] * g1[i], h2 = kept[2] * g2[i];
      f[i] = share * (K_x[i] + of_before * before + (y0 * h0 + y1 * h1 + y2 * h2));
      const double both = before + f[i], u_before = u[i] - dt * w[i];
      stored += y0 * (x0[i] - u[i]) * g0[i] + y1 * (x1[i] - u[i]) * g1[i] + y2 * (x2[i] - u[i]) * g2[i];
      g0[i] = h0 + added[0] * both;
      g1[i] = h1 + added[1] * both;
      g2[i] = h2 + added[2] * both;
      stored -= u_before * (y0 * g0[i] + y1 * g1[i] + y2 * g2[i]);
    }
    return stored;
  }

  void DampedMotion::copy(const DampedMotion &other, const std::vector<unsigned int> &nodes)
  {
    for (unsigned int l = 0; l < n && !memory[0].empty(); ++l)
      for (std::size_t i = 0; i < memory[l].size() / 3; ++i)
        std::copy_n(other.memory[l].begin() + 3 * std::size_t(nodes[i]), 3, memory[l].begin() + 3 * i);
  }

  std::vector<std::vector<double> *> DampedMotion::state()
  {
    std::vector<std::vector<double> *> arrays;
    for (unsigned int l = 0; l < n && !memory[0].empty(); ++l)
      for (auto *array : {&memory[l], &force[l]})
        arrays.push_back(array);
    return arrays;
  }

  double critical_time_step(const double given, const RockDamping &damping)
  {
    const double w = given * std::sqrt(relaxation_of(damping).unrelaxed);
    const double xi = .5 * (damping.mass + damping.stiffness * given * given) / w;
    return 2. * (std::sqrt(1. + xi * xi) - xi) / w;
  }
} // namespace Voussoir
