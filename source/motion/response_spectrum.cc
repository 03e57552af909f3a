// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/motion/response_spectrum.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  Oscillator::Oscillator(double period, double damping, double dt)
      : n_substeps(std::max(1., std::ceil(20. * dt / period - 1e-9)))
  {
    const double w = 2. * M_PI / period;
    const double wd = w * std::sqrt(1. - damping * damping);
    const double h = dt / n_substeps;
    const double e = std::exp(-damping * w * h);
    const double s = e * std::sin(wd * h) / wd;
    const double c = e * std::cos(wd * h);

    stiffness = w * w;
    a[0][0] = c + damping * w * s;
    a[0][1] = s;
    a[1][0] = -w * w * s;
    a[1][1] = c - damping * w * s;

    // Under the acceleration p + q t the particular solution is u = -(p + q t) / w^2 + 2 zeta q / w^3;
    // the rest is free vibration.
    const auto forced = [&](double p, double q) -> std::array<double, 2>
    {
      const double v = -q / (w * w);
      const double u0 = -p / (w * w) + 2. * damping * q / (w * w * w);
      return {{u0 + v * h - a[0][0] * u0 - a[0][1] * v, v - a[1][0] * u0 - a[1][1] * v}};
    };
    start = forced(1., -1. / h);
    finish = forced(0., 1. / h);
  }

  Oscillator::Peak Oscillator::peak(const std::vector<double> &acceleration) const
  {
    Peak        peak;
    double      u = 0., v = 0., largest = 0.;
    std::size_t substep = 0;
    for (std::size_t k = 0; k + 1 < acceleration.size(); ++k)
    {
      const double increment = (acceleration[k + 1] - acceleration[k]) / n_substeps;
      for (std::size_t r = 0; r < n_substeps; ++r)
      {
        const double before = acceleration[k] + r * increment, after = before + increment;
        const double u_next = a[0][0] * u + a[0][1] * v + start[0] * before + finish[0] * after;
        v = a[1][0] * u + a[1][1] * v + start[1] * before + finish[1] * after;
        u = u_next;
        ++substep;
        if (std::abs(u) > largest)
        {
          largest = std::abs(u);
          peak = {stiffness * u, substep, peak.sampled};
        }
      }
      peak.sampled = std::max(peak.sampled, stiffness * std::abs(u));
    }
    return peak;
  }

  std::vector<double> Oscillator::sensitivity(std::size_t substep, std::size_t n_samples) const
  {
    std::vector<double> derivative(n_samples, 0.);
    double              u = stiffness, v = 0.; // the adjoint state
    for (std::size_t j = substep; j-- > 0;)
    {
      const std::size_t k = j / n_substeps;
      const double      before = double(j % n_substeps) / n_substeps, after = before + 1. / n_substeps;
      const double      at_start = u * start[0] + v * start[1], at_finish = u * finish[0] + v * finish[1];
      derivative[k] += (1. - before) * at_start + (1. - after) * at_finish;
      derivative[k + 1] += before * at_start + after * at_finish;

      const double u_previous = a[0][0] * u + a[1][0] * v;
      v = a[0][1] * u + a[1][1] * v;
      u = u_previous;
    }
    return derivative;
  }

  std::vector<double> pseudo_acceleration_spectrum(const std::vector<double> &acceleration, double dt,
                                                   const std::vector<double> &periods, double damping)
  {
    std::vector<double> spectrum;
    for (const double period : periods)
      spectrum.push_back(std::abs(Oscillator(period, damping, dt).peak(acceleration).value));
    return spectrum;
  }

  std::vector<double> logarithmic_periods(double first, double last, unsigned int n_per_decade)
  {
    const unsigned int  n = std::ceil(n_per_decade * std::log10(last / first));
    std::vector<double> periods;
    for (unsigned int i = 0; i <= n; ++i)
      periods.push_back(first * std::pow(last / first, double(i) / n));
    return periods;
  }
} // namespace Voussoir
