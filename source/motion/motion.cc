// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/base/output_file.h>
#include <voussoir/motion/motion.h>
#include <voussoir/motion/motion_artificial.h>
#include <voussoir/motion/motion_files.h>
#include <voussoir/motion/motion_report.h>
#include <voussoir/motion/record_processing.h>
#include <voussoir/motion/response_spectrum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
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

    /** Returns one record or one artificial motion, with all factors. @p is_alone: no rest and no other part.
     * @p begin: of a record, see read_motion() [s]. */
    GroundMotion make_part(const MotionParameters &parameters, const std::string &scene_directory,
                           const bool is_alone, const double begin = 0.)
    {
      GroundMotion          motion;
      const bool            artificial = parameters.source == "artificial";
      double                factor = 1.; // read_motion() includes it, except for records to be matched
      std::array<double, 3> factors = parameters.scale;
      if (artificial || parameters.match != "false")
        factor = parameters.factor;
      for (double &f : factors)
        f *= factor;
      if (artificial)
        motion = make_artificial_motion(parameters);
      else
      {
        MotionParameters as_read = parameters;
        as_read.factor = parameters.match != "false" ? 1. : parameters.factor;
        motion = read_motion(as_read, scene_directory, begin);
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
        motion.fit = next.fit;
        const double begin = motion.acceleration.size() * motion.dt;
        motion.parts.push_back({part.name_of_part(), begin, begin + next.duration()});
        motion.acceleration.insert(motion.acceleration.end(), next.acceleration.begin(),
                                   next.acceleration.end());
        for (const std::string &note : next.notes)
          motion.notes.push_back(parameters.sequence.empty() ? note : part.name_of_part() + ": " + note);
      }
      append_rest(motion, std::lround(parameters.rest_length() / motion.dt));
      if (parameters.source == "artificial" && !parameters.duration_is_automatic())
        motion.notes.push_back(
            "an artificial motion of another Motion/Duration is another motion, also in its "
            "first seconds; to shorten this one, write it with `voussoir motion`, and set "
            "Motion/Source = file");
      add_times(motion);
      return motion;
    }
    /** Adds a note about the displacement of a station relative to the base, and a warning if it does not end.
     * @p name: of the station */
    void add_relative_displacement(const GroundMotion &relative, const std::string &name,
                                   GroundMotion &motion)
    {
      const auto         displacement = relative.integrated().displacement;
      std::ostringstream text, warning;
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
      motion.notes.push_back(name + text.str());
      warning
          << "warning: " << name << "at the end a displacement of " << 1e3 * end
          << " mm relative to the base remains. It strains the dam. If it is an error of the records, correct "
             "the baseline (Motion/Baseline).";
      if (end > MotionCriteria::end_displacement * all)
        motion.notes.push_back(warning.str());
    }

    /** Returns the record of a station at the times of the motion, whose own record has the times @p of_base.
     * It is zero before the first time of its record. */
    GroundMotion record_of(StationParameters &station, const std::string &scene_directory,
                           const GroundMotion &motion, const RecordTimes &of_base, const bool is_alone)
    {
      const RecordTimes  times = record_times(station.record, scene_directory);
      const double       delay = times.first - of_base.first, end = of_base.first + motion.parts[0].end;
      const double       n_before = std::ceil(delay / motion.dt - 1e-4);
      std::ostringstream message;
      if (delay < -1e-6)
        message << "begins at " << times.first
                << " s, before the motion of the lowest base node, which begins at " << of_base.first
                << " s. Cut the record there, or add zeros at the beginning of Motion/File.";
      else if (times.last < end - .01 * motion.dt)
        message << "ends at " << times.last << " s, before the motion of the lowest base node, which ends at "
                << end << " s. Set Motion/Duration to at most " << times.last - of_base.first
                << " s (a multiple of Time step), or give a longer record.";
      else if (n_before * motion.dt > motion.parts[0].end - motion.dt)
        message << "begins at " << times.first << " s, after the end of the motion at " << end
                << " s. Correct its times.";
      if (message.tellp() > 0)
        throw InputError("Motion/Abutments: the record " + station.record.name_of_part() + " of \"" +
                         station.name + "\" " + message.str());
      station.record.duration = motion.parts[0].end - n_before * motion.dt;
      GroundMotion record =
          make_part(station.record, scene_directory, is_alone, std::max(n_before * motion.dt - delay, 0.));
      record.acceleration.insert(record.acceleration.begin(), n_before, {{0., 0., 0.}});
      if (n_before > 0.)
        record.notes.push_back("begins " + number_text(delay) +
                               " s after the motion of the lowest base node");
      return record;
    }

    /** Adds the records of the stations, with the same length as the motion, and notes. */
    void add_stations(const MotionParameters &parameters, const std::string &scene_directory,
                      GroundMotion &motion)
    {
      if (parameters.abutments.empty())
        return;
      const RecordTimes of_base = record_times(parameters, scene_directory);
      for (StationParameters &station : parameters.stations())
      {
        GroundMotion record =
            record_of(station, scene_directory, motion, of_base, parameters.rest_length() == 0.);
        check_samples(record);
        record.acceleration.resize(motion.acceleration.size(), {{0., 0., 0.}});
        motion.stations.push_back({station.is_left, station.height, record.acceleration});
        const std::string name = "station " + station.name + " m, " + station.record.name_of_part() + ": ";
        for (const std::string &note : record.notes)
          motion.notes.push_back(name + note);
        add_relative_displacement(motion.relative(motion.stations.back()), name, motion);
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
    if (parameters.source == "file")
      check_azimuths(parameters, scene_directory);
    MotionParameters  with_target = parameters;
    const std::string note = with_target.read_target(scene_directory);
    motion = make_sequence(with_target, scene_directory);
    check_samples(motion);
    if (!note.empty())
      motion.notes.push_back(note);
    add_stations(with_target, scene_directory, motion);
    return motion;
  }

  void write_suite(const std::vector<EnsembleMember> &members, const std::string &scene_directory,
                   const std::string &file)
  {
    OutputFile out(file);
    out << std::setprecision(9) << "motion,name,factor,misfit_before,misfit_after";
    for (const char c : {'x', 'y', 'z'})
      for (const char *name : {"peak_acceleration", "peak_velocity", "peak_displacement", "arias_intensity",
                               "significant_duration"})
        out << ',' << name << '_' << c;
    out << ",rotd50_0.2,rotd100_0.2,rotd50_1,rotd100_1\n";
    for (std::size_t i = 0; i < members.size() && members[i].factor == members[0].factor; ++i)
    {
      const GroundMotion motion = make_motion(members[i].motion, scene_directory);
      out << i + 1 << ',' << std::quoted(members[i].name, '"', '"') << ',' << motion.fit.factor;
      for (const double misfit : {motion.fit.misfit_before, motion.fit.misfit_after})
        out << ',' << (std::isnan(misfit) ? std::string() : number_text(100. * misfit));
      for (const auto &c : report_motion(motion, members[i].motion).components)
        out << ',' << c.peak_acceleration << ',' << c.peak_velocity << ',' << c.peak_displacement << ','
            << c.arias_intensity << ',' << c.significant_duration;
      for (const double period : {.2, 1.})
        for (const double value : rotated_response(motion.component(0), motion.component(1), motion.dt,
                                                   period, members[i].motion.damping))
          out << ',' << value;
      out << '\n';
    }
    out.check();
  }
} // namespace Voussoir
