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
#include <map>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    /** File of a motion. */
    struct Source
    {
      std::string              name, path;
      int                      direction; ///< 0, 1, 2: of File x, y, z; -1: File
      MotionRecord             record;
      std::vector<std::string> used = {}; ///< names in "Motion/Azimuths"
    };

    /** Sets the parts of a channel in x, y and z, before "Motion/Azimuths" turns it. Throws InputError if its direction
     * does not fit. */
    void place(const Source &source, MotionChannel &channel)
    {
      const bool is_vertical = channel.axis == 'z';
      if (source.direction < 0 ? channel.axis == 'h' || channel.axis == '?'
                               : channel.axis != '?' && is_vertical != (source.direction == 2))
        throw InputError("The ground motion file '" + source.name + "' has the " +
                         (is_vertical ? "vertical " : "horizontal ") + "channel '" + channel.name +
                         (source.direction < 0
                              ? "', but Motion/File needs a_x, a_y, a_z. Set Motion/Azimuths, as in \"x: "
                                "120\" with the azimuth of the downstream direction, or correct the headings."
                              : "', but it is given for the other direction. Exchange the files."));
      channel.parts[source.direction < 0 ? channel.axis - 'x' : source.direction] = channel.sign;
    }

    /** Sets the direction of a channel as "Motion/Azimuths" states it, and its parts in x, y and z. Returns the
     * name in Azimuths, or an empty string. Throws InputError if there is no direction. */
    std::string turn(const MotionParameters &parameters, const Source &source, MotionChannel &channel)
    {
      std::string used;
      for (const std::string &key : {source.name, channel.name})
        if (const auto found = parameters.azimuths.find(key);
            found != parameters.azimuths.end() && key != "x")
          used = key, channel.axis = 'h', channel.azimuth = found->second;
      if (channel.axis == '?' && source.direction == 2)
        channel.axis = 'z';
      if (channel.axis != 'h' && channel.axis != 'z')
        throw InputError(
            "Motion/Azimuths: the channel '" + channel.name + "' of '" + source.name + "' has no azimuth. " +
            (channel.axis == '?' ? "Add it by its name or file, as in \"" + source.name + ": 90\","
                                 : "Name the columns by direction, as in NS, EW,") +
            " or remove Azimuths.");
      if (source.direction >= 0)
        place(source, channel);
      if (channel.name.empty())
        channel.name = source.name;
      const double angle = (parameters.azimuths.at("x") - channel.azimuth) * M_PI / 180.;
      // y is x turned by 90 degrees counterclockwise seen from above
      channel.parts = {{std::cos(angle), std::sin(angle), 0.}};
      if (channel.axis == 'z')
        channel.parts = {{0., 0., channel.sign}};
      return used;
    }

    /** Calls turn() for all channels. Throws InputError unless there are at most two horizontal channels,
     * perpendicular, and one vertical channel. */
    void turn_all(const MotionParameters &parameters, std::vector<Source> &sources)
    {
      std::vector<double> azimuths;
      std::string         names;
      unsigned int        n_vertical = 0;
      for (Source &source : sources)
        for (MotionChannel &channel : source.record.channels)
        {
          source.used.push_back(turn(parameters, source, channel));
          names += (names.empty() ? "" : ", ") + channel.name;
          if (channel.axis == 'z')
            ++n_vertical;
          else
            azimuths.push_back(channel.azimuth);
        }
      if (azimuths.size() > 2 || n_vertical > 1 ||
          (azimuths.size() == 2 && std::abs(std::cos((azimuths[0] - azimuths[1]) * M_PI / 180.)) > .03))
        throw InputError("Motion/Azimuths: the channels are " + names +
                         ". Give at most one vertical channel and two horizontal channels, which must be "
                         "perpendicular within 1.5 degrees.");
    }

    std::vector<Source> read_sources(const MotionParameters &parameters, const std::string &scene_directory)
    {
      std::vector<Source> sources;
      const bool          is_turned = !parameters.azimuths.empty();
      const auto          read = [&](const std::string &name, const int direction)
      {
        const std::string path = (std::filesystem::path(scene_directory) / name).string();
        sources.push_back({name, path, direction,
                           read_motion_record(path,
                                              is_turned       ? 0
                                              : direction < 0 ? 3
                                                              : 1,
                                              parameters.file_step)});
        for (MotionChannel &channel : sources.back().record.channels)
          if (!is_turned)
            place(sources.back(), channel);
        if (const std::string unit = sources.back().record.unit;
            sources.back().record.is_table && !unit.empty() &&
            unit != unit_name(parameters.unit, "acceleration"))
          throw InputError("The ground motion file '" + name + "' has headings with the unit " + unit +
                           ", but Motion/Unit is " + parameters.unit + ". Set Motion/Unit = " + unit +
                           ", or correct the headings.");
        const double start = sources.back().record.start, expected = sources.front().record.start;
        if (std::abs(start - expected) > 1e-6)
          throw InputError("The ground motion file '" + path + "' starts at " + number_text(start) +
                           " s, but the file '" + sources.front().path + "' at " + number_text(expected) +
                           " s. Cut the records to the same first time.");
        const std::string clock = sources.back().record.clock, first = sources.front().record.clock;
        if (!clock.empty() && !first.empty() && clock != first)
          throw InputError("The ground motion file '" + path + "' starts at " + clock + ", but the file '" +
                           sources.front().path + "' at " + first +
                           ". Give records of one earthquake with the same first time.");
      };
      if (!parameters.file.empty())
        read(parameters.file, -1);
      for (unsigned int d = 0; d < 3; ++d)
        if (!parameters.component_files[d].empty())
          read(parameters.component_files[d], d);
      if (is_turned)
        turn_all(parameters, sources);
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
    for (const Source &source : sources)
    {
      const MotionRecord &record = source.record;
      const std::string   own_unit = record.is_table ? parameters.unit : record.unit;
      const double        factor = parameters.factor * unit_of_acceleration(own_unit);
      std::string         channels;
      for (const MotionChannel &channel : record.channels)
      {
        const std::vector<double> a =
            resample(channel.values, record.dt, motion.dt, motion.acceleration.size(), begin);
        std::string text;
        for (unsigned int d = 0; d < 3; ++d)
          if (const double part = std::round(1e12 * channel.parts[d]) / 1e12; part != 0.)
          {
            for (std::size_t k = 0; k < a.size(); ++k)
              motion.acceleration[k][d] = parameters.azimuths.empty()
                                              ? part * factor * a[k]
                                              : motion.acceleration[k][d] + part * factor * a[k];
            text += (text.empty() ? "" : ", ") + number_text(std::round(1e3 * part) / 1e3) + " " + "xyz"[d];
          }
        channels += (channels.empty() ? "" : "; ") + channel.name + " (" + text + ")";
      }
      motion.notes.push_back("'" + source.name + "': " + record.notes + "; channels " + channels + "; unit " +
                             own_unit +
                             (record.is_table && record.unit.empty() ? " (of the input file)" : "") +
                             ", steps of " + number_text(record.dt) + " s");
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

  void check_azimuths(const MotionParameters &parameters, const std::string &scene_directory)
  {
    std::map<std::string, double> unused = parameters.azimuths;
    std::vector<MotionParameters> motions = parameters.parts();
    std::string                   names;
    unused.erase("x");
    for (const StationParameters &station : parameters.stations())
      motions.push_back(station.record);
    for (auto motion = motions.begin(); !unused.empty() && motion != motions.end(); ++motion)
      for (const Source &source : read_sources(*motion, scene_directory))
        for (std::size_t c = 0; c < source.used.size(); ++c)
          unused.erase(source.used[c]), names += (names.empty() ? "" : ", ") + source.record.channels[c].name;
    if (!unused.empty())
      throw InputError("Motion/Azimuths: there is no channel or file '" + unused.begin()->first +
                       "'. The channels are " + names + ". Correct the name.");
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
            for (const MotionChannel &channel : source.record.channels)
              for (const double a : channel.values)
                peak = std::max(peak, !source.record.unit.empty() ? weak : std::abs(a));
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
