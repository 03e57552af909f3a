// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/motion/motion_artificial.h>
#include <voussoir/motion/motion_report.h>
#include <voussoir/motion/record_processing.h>
#include <voussoir/motion/response_spectrum.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    using Vector = std::vector<double>;

    /** Returns the integral of the product of two functions that are linear between equidistant samples, over
     * one sixth of the sampling interval. */
    double product(const Vector &a, const Vector &b)
    {
      double sum = 0.;
      for (std::size_t k = 0; k < a.size(); ++k)
      {
        sum += (k == 0 || k + 1 == a.size() ? 2. : 4.) * a[k] * b[k];
        if (k > 0)
          sum += a[k - 1] * b[k] + a[k] * b[k - 1];
      }
      return sum;
    }

    /** Makes @p a orthogonal to @p b by a multiple of @p along. */
    void remove_part(Vector &a, const Vector &b, const Vector &along)
    {
      const double share = product(a, b) / product(along, b);
      for (std::size_t k = 0; k < a.size(); ++k)
        a[k] -= share * along[k];
    }

    /** Returns the samples with zeros instead of the first and the last one. */
    Vector with_zero_ends(Vector a)
    {
      a.front() = a.back() = 0.;
      return a;
    }

    /** Returns the envelope of a record, relative to its largest value, but not below @p least [-]. It rises from
     * zero in the first half second and decays to zero in the last one, so that additions vanish at both ends. */
    Vector envelope_of(const Vector &a, const double dt, const double least)
    {
      constexpr double  window = 1.; // [s]
      const std::size_t half = std::lround(.5 * window / dt);
      Vector            sum(a.size() + 1, 0.), envelope(a.size());
      for (std::size_t k = 0; k < a.size(); ++k)
        sum[k + 1] = sum[k] + a[k] * a[k];
      for (std::size_t k = 0; k < a.size(); ++k)
        envelope[k] = std::sqrt(sum[std::min(a.size(), k + half + 1)] - sum[k > half ? k - half : 0]);
      const double largest = *std::max_element(envelope.begin(), envelope.end());
      for (std::size_t k = 0; k < a.size(); ++k)
      {
        const double rise =
            std::sin(M_PI / 2. * std::min(1., dt * std::min(k, a.size() - 1 - k) / (.5 * window)));
        envelope[k] = std::max(envelope[k] / largest, least) * rise * rise;
      }
      return envelope;
    }

    bool is_zero(const Vector &a)
    {
      return std::all_of(a.begin(), a.end(), [](const double x) { return x == 0.; });
    }

    /** Returns the factor for which the spectrum of a record has the mean logarithm of the target [-]. */
    double factor_to(const SpectralTarget &target, const Vector &a, const double dt)
    {
      const Vector spectrum = pseudo_acceleration_spectrum(a, dt, target.periods, target.damping);
      double       sum = 0.;
      std::size_t  n = 0;
      for (; n < spectrum.size() && target.periods[n] < MotionCriteria::last_period; ++n)
        sum += std::log(target.pseudo_acceleration[n] / spectrum[n]);
      return std::exp(sum / n);
    }

    /** Returns the measures of one component. @p a: samples [m/s^2]. @p parameters: damping, and target
     * spectrum of the component @p d. */
    MotionReport::Component measures(const Vector &a, const double dt, const MotionParameters &parameters,
                                     const unsigned int d)
    {
      GroundMotion motion;
      motion.dt = dt;
      motion.acceleration.resize(a.size(), {{0., 0., 0.}});
      for (std::size_t k = 0; k < a.size(); ++k)
        motion.acceleration[k][d] = a[k];
      return report_motion(motion, parameters).components[d];
    }

    void check_length(const std::size_t n_steps, const double dt)
    {
      constexpr std::size_t most_steps = 200000; // match_spectrum() stores 230 vectors of that length
      constexpr double      shortest = 1.;       // [s]
      if (n_steps <= most_steps && n_steps * dt >= shortest)
        return;
      std::ostringstream message;
      message << "Motion/Match is true, but the record has " << n_steps << " steps of " << dt
              << " s. Records of 1 s to 200,000 steps can be matched. Change Motion/Duration or Motion/Time "
                 "step, or set Motion/Match to false.";
      throw InputError(message.str());
    }

    std::string percent(const double value)
    {
      std::ostringstream text;
      text << std::fixed << std::setprecision(1) << 100. * value << " %";
      return text.str();
    }

    /** Returns @p factor times @p value; a value at the level of round-off is 0. */
    double rounded(const double factor, const double value)
    {
      return std::abs(factor * value) < 1e-9 ? 0. : factor * value;
    }
  } // namespace

  std::vector<double> without_baseline(const std::vector<double> &a, const unsigned int degree,
                                       const bool has_zero_ends)
  {
    Vector              result = has_zero_ends ? with_zero_ends(a) : a;
    std::vector<Vector> basis; // orthogonal, by Gram and Schmidt
    for (unsigned int power = 0; power <= degree; ++power)
    {
      Vector next;
      for (std::size_t k = 0; k < a.size(); ++k)
        next.push_back(std::pow(2. * k / (a.size() - 1.) - 1., power));
      for (const Vector &other : basis)
        remove_part(next, other, other);
      basis.push_back(std::move(next));
    }
    // The second pass removes the round-off of the first. With zero ends the passes are an iteration, which
    // converges by a factor of about the reciprocal of the number of samples.
    const unsigned int n_passes = has_zero_ends ? 50 : 2;
    for (unsigned int pass = 0; pass < n_passes; ++pass)
      for (const Vector &part : basis)
        remove_part(result, part, has_zero_ends ? with_zero_ends(part) : part);
    return result;
  }

  std::vector<double> matched_record(const std::vector<double> &a, const double dt,
                                     const SpectralTarget &target, const double least_envelope,
                                     const unsigned int n_passes)
  {
    const double factor = factor_to(target, a, dt);
    Vector       scaled = a;
    for (double &value : scaled)
      value *= factor;
    return match_spectrum(scaled, dt, envelope_of(scaled, dt, least_envelope), target,
                          .5 * MotionCriteria::maximum_error, n_passes);
  }

  namespace
  {
    /** Returns a component without its baseline, and adds a note. */
    Vector corrected(const Vector &a, GroundMotion &motion, const MotionParameters &parameters,
                     const unsigned int d, const double factor, const bool has_zero_ends)
    {
      MotionParameters none = parameters;
      none.source = "none"; // no comparison with the target
      const Vector result = without_baseline(a, parameters.baseline == "linear" ? 1 : 2, has_zero_ends);
      const auto   before = measures(a, motion.dt, none, d), after = measures(result, motion.dt, none, d);
      const std::size_t  first = has_zero_ends ? 1 : 0, last = a.size() - 1 - first;
      std::ostringstream note;
      note << std::setprecision(3) << "xyz"[d] << ": " << parameters.baseline << " baseline of "
           << factor * (a[first] - result[first]) << " m/s^2 at the start and "
           << factor * (a[last] - result[last]) << " m/s^2 at the end subtracted; velocity at the end "
           << factor * before.end_velocity << " m/s, now " << rounded(factor, after.end_velocity)
           << "; displacement " << factor * before.end_displacement << " m, now "
           << rounded(factor, after.end_displacement);
      motion.notes.push_back(note.str());
      return result;
    }

    /** Returns a component that matches the target, and adds a note. */
    Vector matched(const Vector &a, GroundMotion &motion, const MotionParameters &parameters,
                   const unsigned int d, const double factor)
    {
      MotionParameters unscaled = parameters; // the target too is without the factors
      unscaled.factor = 1.;
      unscaled.scale = {{1., 1., 1.}};
      const SpectralTarget target = make_target(parameters, d);
      const double         first = factor_to(target, a, motion.dt);
      Vector               scaled = a;
      for (double &value : scaled)
        value *= first;
      const auto before = measures(scaled, motion.dt, unscaled, d);
      Vector     result;
      auto       after = before;
      for (const double least_envelope : {.05, .1, .2, .02})
      {
        const Vector next =
            matched_record(a, motion.dt, target, least_envelope, parameters.matching_iterations);
        const auto of_next = measures(next, motion.dt, unscaled, d);
        if (result.empty() || of_next.maximum_error < after.maximum_error)
        {
          result = next;
          after = of_next;
        }
        if (after.maximum_error <= MotionCriteria::maximum_error)
          break;
      }
      std::ostringstream note;
      note << std::setprecision(3) << "xyz"[d] << ": multiplied by " << first << ", then matched to '"
           << parameters.target_file << "' in the time domain; error of the spectrum "
           << percent(before.maximum_error) << ", now " << percent(after.maximum_error) << " (mean "
           << percent(before.mean_error) << ", now " << percent(after.mean_error) << "); peak acceleration "
           << std::abs(factor) * before.peak_acceleration / standard_gravity << " g, now "
           << std::abs(factor) * after.peak_acceleration / standard_gravity << "; Arias intensity "
           << factor * factor * before.arias_intensity << " m/s, now "
           << factor * factor * after.arias_intensity << " m/s; duration D5-95 "
           << before.significant_duration << " s, now " << after.significant_duration
           << " s; peak displacement " << std::abs(factor) * before.peak_displacement << " m, now "
           << std::abs(factor) * after.peak_displacement << " m";
      motion.notes.push_back(note.str());
      return result;
    }
  } // namespace

  namespace
  {
    /** Returns mean and root of the mean square of ln(target / spectrum) over the horizontal components that move,
     * otherwise of z, and over MotionParameters::band(). Both are 0 without motion. */
    std::array<double, 2> log_misfit(const GroundMotion &motion, const MotionParameters &parameters,
                                     const std::array<double, 3> &factors)
    {
      const auto   band = parameters.band();
      const Vector periods = logarithmic_periods(band[0], band[1], 100);
      double       sum = 0., squares = 0.;
      std::size_t  n = 0;
      for (unsigned int d = 0; d < (n == 0 ? 3 : 2); ++d)
        if (const Vector a = motion.component(d); !is_zero(a) && factors[d] != 0.)
        {
          const Vector spectrum = pseudo_acceleration_spectrum(a, motion.dt, periods, parameters.damping);
          for (std::size_t k = 0; k < periods.size(); ++k, ++n)
          {
            const double misfit = std::log(parameters.target(d, periods[k]) / spectrum[k]);
            sum += misfit, squares += misfit * misfit;
          }
        }
      return {{sum / std::max<std::size_t>(n, 1), std::sqrt(squares / std::max<std::size_t>(n, 1))}};
    }
  } // namespace

  void process_record(GroundMotion &motion, const MotionParameters &parameters,
                      const std::array<double, 3> &factors, const bool has_zero_ends)
  {
    if (motion.acceleration.size() < 6 && parameters.baseline != "none")
      throw InputError(
          "The record of the ground motion has " + std::to_string(motion.acceleration.size()) +
          " samples, too few for Motion/Baseline. Set Baseline to none, or give a longer record.");
    if (parameters.match == "true")
      check_length(motion.acceleration.size() - 1, motion.dt);
    const auto begin = [&] // of a change to the target
    {
      const auto [mean, misfit] = log_misfit(motion, parameters, factors);
      motion.fit = {std::exp(mean), misfit, misfit};
    };
    if (parameters.match == "true")
      begin();
    for (unsigned int d = 0; d < 3; ++d)
    {
      Vector a = motion.component(d);
      if (is_zero(a) || factors[d] == 0.)
        continue;
      if (parameters.baseline != "none")
        a = corrected(a, motion, parameters, d, factors[d], has_zero_ends);
      if (parameters.match == "true")
        a = matched(a, motion, parameters, d, factors[d]);
      for (std::size_t k = 0; k < a.size(); ++k)
        motion.acceleration[k][d] = a[k];
    }
    if (parameters.match == "false")
      return;
    if (parameters.match == "scale")
    {
      begin();
      motion = motion.scaled(motion.fit.factor);
    }
    motion.fit.misfit_after = log_misfit(motion, parameters, factors)[1];
    if (parameters.match == "scale")
      motion.notes.push_back("multiplied by " + number_text(motion.fit.factor) + ", scaled to '" +
                             parameters.target_file + "' from " + number_text(parameters.band()[0]) +
                             " s to " + number_text(parameters.band()[1]) + " s; misfit of the spectrum " +
                             percent(motion.fit.misfit_before) + ", now " + percent(motion.fit.misfit_after));
  }
} // namespace Voussoir
