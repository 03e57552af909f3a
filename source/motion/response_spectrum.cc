// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/simd.h>
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

    // For the acceleration p + q t the particular solution is u = -(p + q t) / w^2 + 2 zeta q / w^3.
    // The remainder is free vibration.
    const auto forced = [&](double p, double q) -> std::array<double, 2>
    {
      const double v = -q / (w * w);
      const double u0 = -p / (w * w) + 2. * damping * q / (w * w * w);
      return {{u0 + v * h - a[0][0] * u0 - a[0][1] * v, v - a[1][0] * u0 - a[1][1] * v}};
    };
    start = forced(1., -1. / h);
    finish = forced(0., 1. / h);
  }

  namespace
  {
    using FourValues = double __attribute__((vector_size(32)));

    VOUSSOIR_INLINE FourValues absolute(const FourValues &x)
    {
      return x < 0. ? -x : x;
    }
  } // namespace

  /** Computes the peaks of four oscillators with the same number of substeps. Each has the values of peak(). */
  VOUSSOIR_WITH_AVX void Oscillator::find_four_peaks(const Oscillator          *oscillator,
                                                     const std::vector<double> &acceleration, Peak *peak)
  {
    FourValues A[4], S[2], F[2], stiffness, u = {}, v = {}, largest = {}, value = {}, at = {}, sampled = {};
    for (unsigned int i = 0; i < 4; ++i)
    {
      stiffness[i] = oscillator[i].stiffness;
      for (unsigned int c = 0; c < 2; ++c)
      {
        A[2 * c][i] = oscillator[i].a[c][0];
        A[2 * c + 1][i] = oscillator[i].a[c][1];
        S[c][i] = oscillator[i].start[c];
        F[c][i] = oscillator[i].finish[c];
      }
    }
    const std::size_t n_substeps = oscillator[0].n_substeps;
    double            substep = 0.;
    for (std::size_t k = 0; k + 1 < acceleration.size(); ++k)
    {
      const double increment = (acceleration[k + 1] - acceleration[k]) / n_substeps;
      for (std::size_t r = 0; r < n_substeps; ++r)
      {
        const double     before = acceleration[k] + r * increment, after = before + increment;
        const FourValues u_next = A[0] * u + A[1] * v + S[0] * before + F[0] * after;
        v = A[2] * u + A[3] * v + S[1] * before + F[1] * after;
        u = u_next;
        substep += 1.;
        const auto is_larger = absolute(u) > largest;
        largest = is_larger ? absolute(u) : largest;
        value = is_larger ? stiffness * u : value;
        at = is_larger ? FourValues{} + substep : at;
      }
      const FourValues now = stiffness * absolute(u);
      sampled = now > sampled ? now : sampled;
    }
    for (unsigned int i = 0; i < 4; ++i)
      peak[i] = {value[i], static_cast<std::size_t>(at[i]), sampled[i]};
  }

  Oscillator::Peak Oscillator::peak(const std::vector<double> &acceleration) const
  {
    Peak                      peak;
    const std::vector<double> all = response(acceleration);
    for (std::size_t j = 0; j < all.size(); ++j)
    {
      if (std::abs(all[j]) > std::abs(peak.value))
        peak = {all[j], j + 1, peak.sampled};
      if ((j + 1) % n_substeps == 0)
        peak.sampled = std::max(peak.sampled, std::abs(all[j]));
    }
    return peak;
  }

  std::vector<Oscillator::Peak> Oscillator::peaks(const std::vector<Oscillator> &oscillators,
                                                  const std::vector<double>     &acceleration)
  {
    constexpr std::size_t n = 4;
    std::vector<Peak>     peaks(oscillators.size());
    for (std::size_t i = 0; i < peaks.size();)
    {
      std::size_t end = i;
      while (end < peaks.size() && end < i + n && oscillators[end].n_substeps == oscillators[i].n_substeps)
        ++end;
      if (end == i + n)
        find_four_peaks(&oscillators[i], acceleration, &peaks[i]);
      else
        for (std::size_t k = i; k < end; ++k)
          peaks[k] = oscillators[k].peak(acceleration);
      i = end;
    }
    return peaks;
  }

  std::vector<double> Oscillator::response(const std::vector<double> &acceleration) const
  {
    std::vector<double> result;
    double              u = 0., v = 0.;
    result.reserve(acceleration.size() * n_substeps);
    for (std::size_t k = 0; k + 1 < acceleration.size(); ++k)
      for (std::size_t r = 0; r < n_substeps; ++r)
      {
        const double increment = (acceleration[k + 1] - acceleration[k]) / n_substeps,
                     before = acceleration[k] + r * increment, after = before + increment,
                     u_next = a[0][0] * u + a[0][1] * v + start[0] * before + finish[0] * after;
        v = a[1][0] * u + a[1][1] * v + start[1] * before + finish[1] * after;
        u = u_next;
        result.push_back(stiffness * u);
      }
    return result;
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
    std::vector<Oscillator> oscillators;
    for (const double period : periods)
      oscillators.emplace_back(period, damping, dt);
    std::vector<double> spectrum;
    for (const Oscillator::Peak &peak : Oscillator::peaks(oscillators, acceleration))
      spectrum.push_back(std::abs(peak.value));
    return spectrum;
  }

  std::array<double, 2> rotated_response(const std::vector<double> &x, const std::vector<double> &y,
                                         const double dt, const double period, const double damping)
  {
    constexpr unsigned int    n_angles = 180;
    const Oscillator          oscillator(period, damping, dt);
    const std::vector<double> of_x = oscillator.response(x), of_y = oscillator.response(y);
    std::vector<double>       largest(n_angles, 0.);
    for (unsigned int i = 0; i < n_angles; ++i)
    {
      const double c = std::cos(M_PI * i / n_angles), s = std::sin(M_PI * i / n_angles);
      for (std::size_t k = 0; k < of_x.size(); ++k)
        largest[i] = std::max(largest[i], std::abs(c * of_x[k] + s * of_y[k]));
    }
    std::sort(largest.begin(), largest.end());
    return {{.5 * (largest[n_angles / 2 - 1] + largest[n_angles / 2]), largest.back()}};
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
