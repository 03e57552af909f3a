// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/motion/resample.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    constexpr double pass_end = .8;     ///< end of the pass band, relative to the new Nyquist frequency
    constexpr double attenuation = 80.; ///< in the stop band, above the new Nyquist frequency [dB]
    constexpr double kaiser = .1102 * (attenuation - 8.7);
    constexpr double half_width =
        .5 * (attenuation - 7.95) /
        (2.285 * M_PI * (1. - pass_end)); ///< half width of the window, in new steps

    /** Returns the record at @p position (in samples) by linear interpolation. */
    double linear(const std::vector<double> &a, const double position)
    {
      const std::size_t k = std::min<std::size_t>(position, a.size() - 2);
      const double      x = std::min(position - k, 1.);
      return (1. - x) * a[k] + x * a[k + 1];
    }

    /** Returns sample @p k of the record, continued by point reflection at its ends. */
    double continued(const std::vector<double> &a, long k)
    {
      const long last = static_cast<long>(a.size()) - 1;
      double     sign = 1., offset = 0.;
      while (k < 0 || k > last)
      {
        offset += sign * 2. * (k < 0 ? a.front() : a.back());
        sign = -sign;
        k = k < 0 ? -k : 2 * last - k;
      }
      return offset + sign * a[k];
    }

    /** Returns the impulse response of the filter up to a factor. @p x: time in new steps. */
    double response(const double x)
    {
      const double place = x / half_width;
      if (!(std::abs(place) < 1.))
        return 0.;
      const double phase = M_PI * .5 * (1. + pass_end) * x;
      return (phase == 0. ? 1. : std::sin(phase) / phase) *
             std::cyl_bessel_i(0., kaiser * std::sqrt(1. - place * place));
    }
  } // namespace

  bool is_coarser(const double new_dt, const double dt)
  {
    return new_dt > 1.001 * dt;
  }

  std::vector<double> resample(const std::vector<double> &a, const double dt, const double new_dt,
                               const std::size_t n, const double begin)
  {
    std::vector<double> result;
    const double        last = static_cast<double>(a.size()) - 1.;
    for (std::size_t j = 0; j < n; ++j)
    {
      const double t = begin + j * new_dt, position = t / dt;
      if (!is_coarser(new_dt, dt) || position >= last)
      {
        result.push_back(linear(a, position));
        continue;
      }
      const double reach = half_width * new_dt / dt;
      double       sum = 0., weights = 0.;
      for (long k = std::ceil(position - reach); k <= position + reach; ++k)
      {
        const double weight = response((t - k * dt) / new_dt);
        sum += weight * continued(a, k);
        weights += weight;
      }
      result.push_back(sum / weights);
    }
    return result;
  }
} // namespace Voussoir
