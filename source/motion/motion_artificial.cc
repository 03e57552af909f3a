// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/motion/motion_artificial.h>
#include <voussoir/motion/motion_report.h>
#include <voussoir/motion/response_spectrum.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <random>

namespace Voussoir
{
  namespace
  {
    constexpr double longest_period = 20.; // longest period of the series [s]

    /** Computes sum_k c_k exp(2 pi i j k / n) for j = 0..n-1 in place (radix 2). n is a power of two. */
    void fourier_sum(std::vector<std::complex<double>> &c)
    {
      const std::size_t n = c.size();
      for (std::size_t i = 1, j = 0; i < n; ++i) // bit reversal
      {
        std::size_t bit = n >> 1;
        for (; j & bit; bit >>= 1)
          j ^= bit;
        j ^= bit;
        if (i < j)
          std::swap(c[i], c[j]);
      }
      for (std::size_t length = 2; length <= n; length *= 2)
      {
        std::vector<std::complex<double>> factors(length / 2);
        for (std::size_t k = 0; k < length / 2; ++k)
          factors[k] = std::polar(1., 2. * M_PI * k / length);
        for (std::size_t begin = 0; begin < n; begin += length)
          for (std::size_t k = 0; k < length / 2; ++k)
          {
            const auto even = c[begin + k], odd = factors[k] * c[begin + k + length / 2];
            c[begin + k] = even + odd;
            c[begin + k + length / 2] = even - odd;
          }
      }
    }

    /** Returns a uniform random number in [0, 1), identical on all platforms. The standard does not guarantee
     * this for std::uniform_real_distribution. */
    double uniform(std::mt19937_64 &generator)
    {
      return (generator() >> 11) * 0x1p-53;
    }

    /** Returns the envelope at time @p t: rise with t^2, 1, exponential decay. In the last twentieth of the
     * duration, a cosine taper to zero multiplies it. */
    double envelope_at(const MotionParameters &parameters, double t)
    {
      const double         duration = parameters.length();
      const MotionEnvelope envelope = parameters.envelope();
      const double         taper = std::min(1., (duration - t) / (0.05 * duration));
      const double         end = 0.5 * (1. - std::cos(M_PI * std::max(taper, 0.)));
      if (t < envelope.rise_end)
        return end * t * t / (envelope.rise_end * envelope.rise_end);
      return end * std::exp(-envelope.decay_rate * std::max(t - envelope.decay_begin, 0.));
    }

    /** Returns the power spectral density of the acceleration for a pseudo-acceleration Sa (Kaul 1978):
     *
     *     S(w) = - zeta / (pi w) Sa^2 / ln(-pi / (w T_d) ln(1 - p))
     *
     * p is the probability of exceedance, T_d the duration. */
    double power_spectrum(double w, double pseudo_acceleration, double damping, double duration)
    {
      constexpr double p = 0.1;
      const double     crossing = -M_PI / (w * duration) * std::log(1. - p);
      return -damping / (M_PI * w) * pseudo_acceleration * pseudo_acceleration /
             std::log(std::min(crossing, 0.5));
    }

    /** Returns y at the value @p at by linear interpolation over the logarithm of x. The values x increase.
     * The result is constant beyond the ends. */
    double interpolate(const std::vector<double> &x, const std::vector<double> &y, double at)
    {
      const std::size_t i = std::lower_bound(x.begin(), x.end(), at) - x.begin();
      if (i == 0)
        return y.front();
      if (i == x.size())
        return y.back();
      return y[i - 1] + (y[i] - y[i - 1]) * std::log(at / x[i - 1]) / std::log(x[i] / x[i - 1]);
    }

    /** Trigonometric series sum_k A_k cos(w_k t + phi_k), multiplied by an envelope. */
    struct Series
    {
      std::vector<double> frequencies, amplitudes, phases; // [Hz], [m/s^2], [rad], for k = 1, 2, ...
      std::size_t         n_points;                        // points per period of the series, a power of two

      std::vector<double> evaluate(const std::vector<double> &envelope) const
      {
        std::vector<std::complex<double>> sum(n_points);
        for (std::size_t k = 0; k < amplitudes.size(); ++k)
          sum[k + 1] = std::polar(amplitudes[k], phases[k]);
        fourier_sum(sum);
        std::vector<double> acceleration;
        for (std::size_t j = 0; j < envelope.size(); ++j)
          acceleration.push_back(envelope[j] * sum[j].real());
        return acceleration;
      }
    };

    Series make_series(const MotionParameters &parameters, unsigned int direction, unsigned int attempt)
    {
      const double lowest = 1. / longest_period, highest = 1.25 / MotionCriteria::first_period; // [Hz]

      Series series;
      for (series.n_points = 1; series.n_points <= parameters.n_steps();)
        series.n_points *= 2;
      const double         df = 1. / (series.n_points * parameters.time_step);
      const MotionEnvelope envelope = parameters.envelope();

      std::seed_seq   seeds{parameters.seed, direction, attempt};
      std::mt19937_64 generator(seeds);
      for (std::size_t k = 1; k < series.n_points / 2 && k * df <= highest; ++k)
      {
        const double f = k * df;
        series.frequencies.push_back(f);
        series.phases.push_back(2. * M_PI * uniform(generator));
        const double S = power_spectrum(2. * M_PI * f, parameters.target(direction, 1. / f),
                                        parameters.damping, envelope.decay_begin - envelope.rise_end);
        series.amplitudes.push_back(f < lowest ? 0. : std::sqrt(4. * S * 2. * M_PI * df));
      }
      return series;
    }

    /** Multiplies the amplitudes by the ratio of the target to the computed spectrum, in six passes. */
    void correct_amplitudes(Series &series, double dt, const std::vector<double> &envelope,
                            const SpectralTarget &target)
    {
      for (unsigned int pass = 0; pass < 6; ++pass)
      {
        std::vector<double> ratios =
            pseudo_acceleration_spectrum(series.evaluate(envelope), dt, target.periods, target.damping);
        for (std::size_t i = 0; i < ratios.size(); ++i)
          ratios[i] = target.pseudo_acceleration[i] / ratios[i];
        for (std::size_t k = 0; k < series.amplitudes.size(); ++k)
          series.amplitudes[k] *= interpolate(target.periods, ratios, 1. / series.frequencies[k]);
      }
    }

    /** Returns the largest ratio of an error to its limit in MotionCriteria, for a component and its
     * correlation with earlier components. It is at most 1 if all criteria are satisfied. */
    double misfit(const MotionReport &report, unsigned int direction)
    {
      using namespace MotionCriteria;

      const auto &component = report.components[direction];
      double misfit = std::max(component.maximum_error / maximum_error, component.mean_error / mean_error);
      for (const double rho : report.correlations)
        misfit = std::max(misfit, std::abs(rho) / correlation);
      return misfit;
    }
  } // namespace

  SpectralTarget make_target(const MotionParameters &parameters, unsigned int direction)
  {
    using namespace MotionCriteria;

    SpectralTarget target;
    target.damping = parameters.damping;
    target.peak_acceleration = parameters.target(direction, 0.);
    target.periods = logarithmic_periods(first_period, last_period, 100);
    target.periods.pop_back();
    for (const double period : logarithmic_periods(last_period, longest_period, 10))
      target.periods.push_back(period);
    for (const double period : target.periods)
      target.pseudo_acceleration.push_back(parameters.target(direction, period));
    return target;
  }

  std::vector<double> make_artificial_component(const MotionParameters &parameters, unsigned int direction,
                                                unsigned int attempt)
  {
    std::vector<double> envelope;
    for (unsigned int k = 0; k <= parameters.n_steps(); ++k)
      envelope.push_back(envelope_at(parameters, k * parameters.time_step));

    const SpectralTarget target = make_target(parameters, direction);
    Series               series = make_series(parameters, direction, attempt);
    correct_amplitudes(series, parameters.time_step, envelope, target);
    return match_spectrum(series.evaluate(envelope), parameters.time_step, envelope, target,
                          0.75 *
                              MotionCriteria::maximum_error, // margin for periods between those of the target
                          parameters.matching_iterations);
  }

  GroundMotion make_artificial_motion(const MotionParameters &parameters)
  {
    constexpr unsigned int n_attempts = 6;

    MotionParameters unscaled = parameters;
    unscaled.scale = {{1., 1., 1.}};
    unscaled.factor = 1.;

    GroundMotion best;
    best.dt = parameters.time_step;
    best.acceleration.resize(parameters.n_steps() + 1, {{0., 0., 0.}});
    for (unsigned int direction = 0; direction < 3; ++direction)
    {
      double       least = std::numeric_limits<double>::max();
      GroundMotion motion = best;
      for (unsigned int attempt = 0; attempt < n_attempts && least > 1.; ++attempt)
      {
        const std::vector<double> component = make_artificial_component(unscaled, direction, attempt);
        for (std::size_t k = 0; k < component.size(); ++k)
          motion.acceleration[k][direction] = component[k];
        const double current = misfit(report_motion(motion, unscaled), direction);
        if (current < least)
        {
          least = current;
          best = motion;
        }
      }
    }
    return best;
  }
} // namespace Voussoir
