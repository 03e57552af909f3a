// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/base/units.h>
#include <voussoir/motion/motion_files.h>
#include <voussoir/motion/motion_record.h>
#include <voussoir/motion/resample.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    struct Source
    {
      std::string  path;
      unsigned int first; ///< component of the motion for the first one of the record
      MotionRecord record;
    };

    std::vector<Source> read_sources(const MotionParameters &parameters, const std::string &scene_directory)
    {
      std::vector<Source> sources;
      const auto          read = [&](const std::string &name, unsigned int first, unsigned int n_components)
      {
        const std::string path = (std::filesystem::path(scene_directory) / name).string();
        sources.push_back({path, first, read_motion_record(path, n_components)});
        if (const std::string unit = sources.back().record.unit;
            !unit.empty() && unit != unit_name(parameters.unit, "acceleration"))
          throw InputError("The ground motion file '" + name + "' has headings with the unit " + unit +
                           ", but Motion/Unit is " + parameters.unit + ". Set Motion/Unit = " + unit +
                           ", or correct the headings.");
        const double start = sources.back().record.start, expected = sources.front().record.start;
        if (std::abs(start - expected) > 1e-6)
          throw InputError("The ground motion file '" + path + "' starts at " + number_text(start) +
                           " s, but the file '" + sources.front().path + "' at " + number_text(expected) +
                           " s. Cut the records to the same first time.");
      };
      if (!parameters.file.empty())
        read(parameters.file, 0, 3);
      for (unsigned int d = 0; d < 3; ++d)
        if (!parameters.component_files[d].empty())
          read(parameters.component_files[d], d, 1);
      return sources;
    }

    /** Returns the number of whole steps of @p dt in the record, with a tolerance for rounded times. */
    double steps_in(const MotionRecord &record, const double dt)
    {
      return std::floor((record.duration() + 0.01 * record.dt) / dt);
    }

    /** Returns the number of time steps. Adds a note if it is that of the records. */
    std::size_t find_n_steps(const MotionParameters &parameters, const std::vector<Source> &sources,
                             std::vector<std::string> &notes)
    {
      const auto shorter = [](const Source &a, const Source &b)
      { return a.record.duration() < b.record.duration(); };
      const Source      &shortest = *std::min_element(sources.begin(), sources.end(), shorter);
      std::ostringstream message;
      if (!parameters.duration_is_automatic())
      {
        if (shortest.record.duration() >= parameters.duration - 0.01 * shortest.record.dt)
          return parameters.n_steps();
        message << "The ground motion file '" << shortest.path << "' lasts " << shortest.record.duration()
                << " s, less than Motion/Duration, " << parameters.duration << " s. Set Duration to at most "
                << shortest.record.duration()
                << " s (a multiple of Time step), or to -1 (length of the shortest record), or give a longer "
                   "record.";
        throw InputError(message.str());
      }
      const double n = steps_in(shortest.record, parameters.time_step);
      if (!(n >= 1. && n <= MotionParameters::most_steps))
      {
        message << "The ground motion file '" << shortest.path << "' lasts " << shortest.record.duration()
                << " s, which is " << (n < 1. ? "less than one step" : "more than ten million steps")
                << " (Motion/Time step is " << parameters.time_step << " s). Correct the time step"
                << (n < 1. ? ", or give a longer record." : ".");
        throw InputError(message.str());
      }
      message << "duration " << n * parameters.time_step << " s, that of "
              << (sources.size() > 1 ? "the shortest record, '" : "the record '") << shortest.path << "'";
      notes.push_back(message.str());
      return n;
    }
  } // namespace

  RecordTimes record_times(const MotionParameters &parameters, const std::string &scene_directory)
  {
    const std::vector<Source> sources = read_sources(parameters, scene_directory);
    RecordTimes               times = {sources.front().record.start, HUGE_VAL};
    for (const Source &source : sources)
      times.last = std::min(times.last, times.first + source.record.duration());
    return times;
  }

  GroundMotion read_motion(const MotionParameters &parameters, const std::string &scene_directory,
                           const double begin)
  {
    const std::vector<Source> sources = read_sources(parameters, scene_directory);
    GroundMotion              motion;
    motion.dt = parameters.time_step;
    motion.acceleration.resize(find_n_steps(parameters, sources, motion.notes) + 1, {{0., 0., 0.}});
    const double unit = unit_of_acceleration(parameters.unit);
    for (const Source &source : sources)
    {
      const MotionRecord &record = source.record;
      const double        factor = parameters.factor * (record.in_g ? standard_gravity : unit);
      for (std::size_t c = 0; c < record.components.size(); ++c)
      {
        const std::vector<double> a =
            resample(record.components[c], record.dt, motion.dt, motion.acceleration.size(), begin);
        for (std::size_t k = 0; k < a.size(); ++k)
          motion.acceleration[k][source.first + c] = factor * a[k];
      }
      if (is_coarser(motion.dt, record.dt))
      {
        std::ostringstream note;
        note << "'" << source.path << "' has steps of " << record.dt << " s: low-pass filtered at "
             << 0.5 / motion.dt << " Hz, then sampled at " << motion.dt << " s";
        motion.notes.push_back(note.str());
      }
    }
    return motion;
  }

  std::string unit_warning(const MotionParameters &parameters, const std::string &scene_directory)
  {
    constexpr double weak = 1.; // [m/s^2]
    double           peak = 0.;
    try
    {
      if (parameters.source == "file")
        for (const MotionParameters &part : parameters.parts())
          for (const Source &source : read_sources(part, scene_directory))
            for (const auto &component : source.record.components)
              for (const double a : component)
                peak = std::max(peak, source.record.in_g || !source.record.unit.empty() ? weak : std::abs(a));
    }
    catch (const InputError &)
    {
      return ""; // make_motion() reports the error
    }
    std::string what = peak > 0. && peak < weak ? "the largest value of the record" : "";
    if (const double of_target = parameters.target_lacks_unit() ? parameters.target(0, 0.) : weak;
        what.empty() && of_target < weak)
      peak = of_target, what = "the peak acceleration of the target spectrum";
    if (what.empty())
      return "";
    std::ostringstream text;
    text.precision(3);
    text
        << what << " is " << peak
        << ". The unit m/s^2 is assumed, because the input file has no Motion/Unit. If the file is in g, set "
           "Motion/Unit = g. Otherwise set Motion/Unit = m/s^2.";
    return text.str();
  }
} // namespace Voussoir
