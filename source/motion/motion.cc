// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/motion/motion.h>
#include <voussoir/motion/motion_artificial.h>
#include <voussoir/motion/motion_files.h>
#include <voussoir/motion/record_processing.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    /** Throws InputError if a sample is not finite or exceeds 1000 g. */
    void check_samples(const GroundMotion &motion)
    {
      constexpr double limit = 1000. * standard_gravity;
      for (std::size_t k = 0; k < motion.acceleration.size(); ++k)
        for (const double a : motion.acceleration[k])
          if (!(std::abs(a) <= limit))
          {
            std::ostringstream message;
            message << "The acceleration of the ground motion at " << k * motion.dt << " s is " << a
                    << " m/s^2, " << a / standard_gravity
                    << " g. The limit is 1000 g. Check the entries Motion/Unit, Factor, Scale x, y, z and "
                       "Peak acceleration.";
            throw InputError(message.str());
          }
    }

    /** Returns one record or one artificial motion, with all factors. @p is_alone: no rest and no other part. */
    GroundMotion make_part(const MotionParameters &parameters, const std::string &scene_directory,
                           const bool is_alone)
    {
      GroundMotion          motion;
      const bool            artificial = parameters.source == "artificial";
      double                factor = 1.; // read_motion() includes it, except for records to be matched
      std::array<double, 3> factors = parameters.scale;
      if (artificial || parameters.match)
        factor = parameters.factor;
      for (double &f : factors)
        f *= factor;
      if (artificial)
        motion = make_artificial_motion(parameters);
      else
      {
        MotionParameters as_read = parameters;
        as_read.factor = parameters.match ? 1. : parameters.factor;
        motion = read_motion(as_read, scene_directory);
        process_record(motion, parameters, factors, !is_alone);
      }
      for (auto &sample : motion.acceleration)
        for (unsigned int d = 0; d < 3; ++d)
          sample[d] *= factors[d];
      return motion;
    }

    /** Appends zero acceleration. Throws InputError if the motion becomes too long. */
    void append_rest(GroundMotion &motion, const double n_samples)
    {
      if (!(motion.acceleration.size() + n_samples <= MotionParameters::most_steps))
        throw InputError("The ground motion with its rests would have more than ten million steps. Reduce "
                         "Motion/Rest, or increase Motion/Time step.");
      motion.acceleration.resize(motion.acceleration.size() + std::size_t(n_samples), {{0., 0., 0.}});
    }

    /** Adds a note with the times of each part, if there are several. */
    void add_times(GroundMotion &motion)
    {
      for (std::size_t k = 0; motion.parts.size() > 1 && k < motion.parts.size(); ++k)
      {
        std::ostringstream note;
        note << "part " << k + 1 << ", " << motion.parts[k].name << ": " << motion.parts[k].begin << " s to "
             << motion.parts[k].end << " s, rest until " << motion.end_of_rest(k) << " s";
        motion.notes.push_back(note.str());
      }
    }

    /** Returns the parts one after another, each one followed by "Rest". */
    GroundMotion make_sequence(const MotionParameters &parameters, const std::string &scene_directory)
    {
      GroundMotion motion;
      motion.dt = parameters.time_step;
      const auto parts = parameters.parts();
      const bool is_alone = parts.size() == 1 && parameters.rest_length() == 0.;
      for (const MotionParameters &part : parts)
      {
        const GroundMotion next = make_part(part, scene_directory, is_alone);
        if (!motion.parts.empty()) // the first sample of the next part ends the rest
          append_rest(motion, std::lround(parameters.rest_length() / motion.dt) - 1);
        const double begin = motion.acceleration.size() * motion.dt;
        motion.parts.push_back({part.name_of_part(), begin, begin + next.duration()});
        motion.acceleration.insert(motion.acceleration.end(), next.acceleration.begin(),
                                   next.acceleration.end());
        for (const std::string &note : next.notes)
          motion.notes.push_back(parameters.sequence.empty() ? note : part.name_of_part() + ": " + note);
      }
      append_rest(motion, std::lround(parameters.rest_length() / motion.dt));
      add_times(motion);
      return motion;
    }
    /** Returns the largest and the last displacement of a motion relative to the base in words. */
    std::string relative_displacement(const GroundMotion &relative)
    {
      const auto         displacement = relative.integrated().displacement;
      std::ostringstream text;
      double             all = 0., end = 0.;
      for (unsigned int c = 0; c < 3; ++c)
      {
        double largest = 0.;
        for (const auto &u : displacement)
          largest = std::max(largest, std::abs(u[c]));
        text << (c == 0 ? "largest displacement relative to the base " : ", ") << 1e3 * largest << " mm in "
             << "xyz"[c];
        all = std::max(all, largest), end = std::max(end, std::abs(displacement.back()[c]));
      }
      if (end > MotionCriteria::end_displacement * all)
        text << ". warning: at the end " << 1e3 * end
             << " mm remain. They strain the dam. If they are an error of the records, correct the baseline "
                "(Motion/Baseline)";
      return text.str();
    }

    /** Adds the records of the stations, with the same length as the motion, and notes. */
    void add_stations(const MotionParameters &parameters, const std::string &scene_directory,
                      GroundMotion &motion)
    {
      for (StationParameters &station : parameters.stations())
      {
        station.record.duration = motion.parts[0].end;
        GroundMotion record = make_part(station.record, scene_directory, parameters.rest_length() == 0.);
        check_samples(record);
        record.acceleration.resize(motion.acceleration.size(), {{0., 0., 0.}});
        motion.stations.push_back({station.is_left, station.height, record.acceleration});
        const std::string name = "station " + station.name + " m, " + station.record.name_of_part() + ": ";
        for (const std::string &note : record.notes)
          motion.notes.push_back(name + note);
        motion.notes.push_back(name + relative_displacement(motion.relative(motion.stations.back())));
      }
    }
  } // namespace

  GroundMotion make_motion(const MotionParameters &parameters, const std::string &scene_directory)
  {
    parameters.check();
    GroundMotion motion;
    if (parameters.source == "none")
    {
      motion.dt = parameters.time_step;
      motion.acceleration.resize(parameters.n_steps() + 1, {{0., 0., 0.}});
      return motion;
    }
    MotionParameters with_target = parameters;
    with_target.read_target(scene_directory);
    motion = make_sequence(with_target, scene_directory);
    check_samples(motion);
    add_stations(with_target, scene_directory, motion);
    return motion;
  }
} // namespace Voussoir
