// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/motion/motion_report.h>
#include <voussoir/motion/response_spectrum.h>
#include <voussoir/motion/spectral_matching.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <ostream>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    /** Returns the correlation coefficient of Pearson. It is zero if a vector is constant. */
    double correlation(const std::vector<double> &a, const std::vector<double> &b)
    {
      double mean_a = 0., mean_b = 0.;
      for (std::size_t k = 0; k < a.size(); ++k)
      {
        mean_a += a[k] / a.size();
        mean_b += b[k] / b.size();
      }
      double aa = 0., bb = 0., ab = 0.;
      for (std::size_t k = 0; k < a.size(); ++k)
      {
        aa += (a[k] - mean_a) * (a[k] - mean_a);
        bb += (b[k] - mean_b) * (b[k] - mean_b);
        ab += (a[k] - mean_a) * (b[k] - mean_b);
      }
      return aa * bb > 0. ? ab / std::sqrt(aa * bb) : 0.;
    }

    /** Returns the measures of the component @p d with the accelerations @p a [m/s^2]. */
    MotionReport::Component measure(const std::vector<double> &a, const double dt,
                                    const MotionIntegrals &integrals, const unsigned int d)
    {
      MotionReport::Component result;

      std::vector<double> energy(a.size(), 0.); // integral of a^2
      for (std::size_t k = 0; k < a.size(); ++k)
      {
        result.end_velocity = integrals.velocity[k][d];
        result.end_displacement = integrals.displacement[k][d];
        if (k > 0)
          energy[k] = energy[k - 1] + dt * (a[k - 1] * a[k - 1] + a[k - 1] * a[k] + a[k] * a[k]) / 3.;
        result.peak_acceleration = std::max(result.peak_acceleration, std::abs(a[k]));
        result.peak_velocity = std::max(result.peak_velocity, std::abs(result.end_velocity));
        result.peak_displacement = std::max(result.peak_displacement, std::abs(result.end_displacement));
      }
      if (energy.empty())
        return result;

      const auto time_of = [&](double share) {
        return dt * (std::lower_bound(energy.begin(), energy.end(), share * energy.back()) - energy.begin());
      };
      result.arias_intensity = M_PI / (2. * standard_gravity) * energy.back();
      result.significant_duration = time_of(0.95) - time_of(0.05);
      return result;
    }

    /** Returns the largest errors of the parts of a motion. An oscillator of long period still vibrates after
     * the rest, so that the spectrum of the whole motion differs from those of its parts. */
    SpectralError largest_error(const GroundMotion &motion, const std::vector<double> &a,
                                const SpectralTarget &target)
    {
      if (motion.parts.size() < 2)
        return spectral_error(a, motion.dt, target);
      SpectralError largest;
      for (const MotionPart &part : motion.parts)
      {
        const auto begin = a.begin() + std::lround(part.begin / motion.dt),
                   end = a.begin() + std::lround(part.end / motion.dt) + 1;
        const SpectralError error = spectral_error({begin, end}, motion.dt, target);
        largest.maximum = std::max(largest.maximum, error.maximum);
        largest.mean = std::max(largest.mean, error.mean);
      }
      return largest;
    }
  } // namespace

  MotionReport report_motion(const GroundMotion &motion, const MotionParameters &parameters)
  {
    MotionReport                       report;
    std::array<std::vector<double>, 3> accelerations;
    const MotionIntegrals              integrals = motion.integrated();
    report.artificial = parameters.source == "artificial";
    report.matched = parameters.source == "file" && parameters.match == "true";
    report.has_target = parameters.has_target();
    for (unsigned int d = 0; d < 3; ++d)
    {
      accelerations[d] = motion.component(d);
      report.components[d] = measure(accelerations[d], motion.dt, integrals, d);
      const double factor = std::abs(parameters.factor * parameters.scale[d]);
      if (!report.has_target || factor == 0. || report.components[d].peak_acceleration == 0.)
        continue;

      SpectralTarget target;
      target.damping = parameters.damping;
      target.periods = logarithmic_periods(parameters.band()[0], parameters.band()[1], 200);
      for (const double period : target.periods)
        target.pseudo_acceleration.push_back(factor * parameters.target(d, period));
      const SpectralError error = largest_error(motion, accelerations[d], target);
      report.components[d].maximum_error = error.maximum;
      report.components[d].mean_error = error.mean;
    }
    report.correlations = {{correlation(accelerations[0], accelerations[1]),
                            correlation(accelerations[0], accelerations[2]),
                            correlation(accelerations[1], accelerations[2])}};
    return report;
  }

  namespace
  {
    using Component = MotionReport::Component;

    void add_spectrum_warnings(const MotionReport &report, std::vector<std::string> &warnings)
    {
      for (unsigned int d = 0; d < 3; ++d)
      {
        const Component &c = report.components[d];
        if (c.maximum_error <= MotionCriteria::maximum_error && c.mean_error <= MotionCriteria::mean_error)
          continue;
        std::ostringstream text;
        text << std::fixed << std::setprecision(1) << "the spectrum of "
             << "xyz"[d] << " has an error of up to " << 100. * c.maximum_error << " % ("
             << 100. * c.mean_error << " % on average); the limits are 10 % (5 %). Try more \"Matching"
             << " iterations\", another " << (report.matched ? "record" : "\"Seed\"")
             << ", a longer \"Duration\" or a smaller \"Time step\".";
        warnings.push_back(text.str());
      }
      const std::array<const char *, 3> pairs = {{"x-y", "x-z", "y-z"}};
      for (unsigned int i = 0; i < 3 && report.artificial; ++i)
        if (std::abs(report.correlations[i]) > MotionCriteria::correlation)
        {
          std::ostringstream text;
          text << std::fixed << std::setprecision(3) << "the correlation of " << pairs[i] << " is "
               << report.correlations[i] << "; the limit is 0.3. Try another \"Seed\".";
          warnings.push_back(text.str());
        }
    }
  } // namespace

  std::vector<std::string> motion_warnings(const MotionReport &report)
  {
    std::vector<std::string> warnings;
    if (report.artificial || report.matched)
      add_spectrum_warnings(report, warnings);
    for (const std::string &warning : {size_warning(report), end_warning(report)})
      if (!warning.empty())
        warnings.push_back(warning);
    return warnings;
  }

  std::string size_warning(const MotionReport &report)
  {
    constexpr double   lowest_peak = .005, highest_peak = 2.; // [g]
    constexpr double   fastest = 5., farthest = 10.;          // [m/s], [m]
    double             peak = 0., velocity = 0., displacement = 0.;
    std::ostringstream text;
    text << std::setprecision(3);
    for (const Component &c : report.components)
    {
      peak = std::max(peak, c.peak_acceleration / standard_gravity);
      velocity = std::max(velocity, c.peak_velocity);
      displacement = std::max(displacement, c.peak_displacement);
    }
    if (peak > highest_peak || peak < lowest_peak)
      text << "the peak acceleration of the motion is " << peak
           << " g; usual is 0.005 to 2 g. Check Motion/Unit, Motion/Factor and Motion/Scale x, y, z.";
    else if (velocity > fastest || displacement > farthest)
      text << "the motion has a peak velocity of " << velocity << " m/s and a peak displacement of "
           << displacement << " m; usual is at most " << fastest << " m/s and " << farthest
           << " m. Check the times and the unit of the record (Motion/Unit), and Motion/Time step.";
    return text.str();
  }

  std::string end_warning(const MotionReport &report)
  {
    std::ostringstream text;
    text << std::setprecision(3);
    for (unsigned int d = 0; d < 3; ++d)
    {
      const Component &c = report.components[d];
      const double     displacement = std::abs(c.end_displacement), velocity = std::abs(c.end_velocity);
      if (displacement > MotionCriteria::end_displacement * c.peak_displacement ||
          velocity > MotionCriteria::end_velocity * c.peak_velocity)
        text << (text.tellp() > 0 ? "; " : "") << "in "
             << "xyz"[d] << " displacement " << c.end_displacement << " m, "
             << 100. * displacement / c.peak_displacement << " % of its peak, velocity " << c.end_velocity
             << " m/s, " << 100. * velocity / c.peak_velocity << " %";
    }
    if (text.tellp() == 0)
      return "";
    return "the motion does not end at rest in its initial position: " + text.str() +
           " (limits: 20 % and 10 %). Correct the baseline (Motion/Baseline), or increase Motion/Duration until "
           "the record is at rest.";
  }

  void print_spectra(const GroundMotion &motion, const MotionParameters &parameters, std::ostream &out)
  {
    std::ostringstream table;
    table << "Spectra [g], damping " << 100. * parameters.damping
          << " %\nperiod [s]         x         y         z    RotD50   RotD100"
          << (parameters.has_target() ? "  target x" : "") << '\n'
          << std::fixed << std::setprecision(3);
    const auto print = [&](const double value) { table << std::setw(10) << value / standard_gravity; };
    for (const double period : {.05, .1, .2, .3, .5, .75, 1., 2., 3.})
    {
      table << std::setw(10) << period;
      for (unsigned int d = 0; d < 3; ++d)
        print(pseudo_acceleration_spectrum(motion.component(d), motion.dt, {period}, parameters.damping)[0]);
      for (const double value :
           rotated_response(motion.component(0), motion.component(1), motion.dt, period, parameters.damping))
        print(value);
      if (parameters.has_target())
        print(std::abs(parameters.factor * parameters.scale[0]) * parameters.target(0, period));
      table << '\n';
    }
    out << table.str();
  }

  void print_report(const MotionReport &report, std::ostream &out)
  {
    std::ostringstream table;
    table << std::fixed << std::setprecision(3);
    const auto row =
        [&](const char *name, const char *unit, const std::function<double(const Component &)> &value)
    {
      table << std::left << std::setw(24) << name << std::setw(6) << unit << std::right;
      for (const Component &component : report.components)
      {
        const double number = value(component);
        table << std::setw(10) << (std::abs(number) < 0.0005 ? 0. : number); // not -0.000
      }
      table << '\n';
    };

    table << std::left << std::setw(30) << "Ground motion" << std::right << std::setw(10) << 'x'
          << std::setw(10) << 'y' << std::setw(10) << 'z' << '\n';
    row("peak acceleration", "g", [](const Component &c) { return c.peak_acceleration / standard_gravity; });
    row("peak velocity", "m/s", [](const Component &c) { return c.peak_velocity; });
    row("peak displacement", "m", [](const Component &c) { return c.peak_displacement; });
    row("end velocity", "m/s", [](const Component &c) { return c.end_velocity; });
    row("end displacement", "m", [](const Component &c) { return c.end_displacement; });
    row("Arias intensity", "m/s", [](const Component &c) { return c.arias_intensity; });
    row("duration D5-95", "s", [](const Component &c) { return c.significant_duration; });
    if (report.has_target)
    {
      row("spectrum, maximum error", "%", [](const Component &c) { return 100. * c.maximum_error; });
      row("spectrum, mean error", "%", [](const Component &c) { return 100. * c.mean_error; });
    }
    const std::array<const char *, 3> pairs = {{"x-y", "x-z", "y-z"}};
    table << "correlation";
    for (unsigned int i = 0; i < 3; ++i)
      table << "   " << pairs[i] << ' ' << report.correlations[i];
    table << '\n';

    for (const std::string &warning : motion_warnings(report))
      table << "warning: " << warning << '\n';
    out << table.str();
  }
} // namespace Voussoir
