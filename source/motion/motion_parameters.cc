// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/entries.h>
#include <voussoir/base/error.h>
#include <voussoir/base/model_choices.h>
#include <voussoir/base/number_text.h>
#include <voussoir/base/units.h>
#include <voussoir/motion/ground_motion.h>
#include <voussoir/motion/motion_parameters.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    namespace Patterns = dealii::Patterns;

    const char *const names_of_axes[] = {"x", "y", "z"};
  } // namespace

  void MotionParameters::add_parameters(Entries &prm)
  {
    prm.enter_subsection("Motion");
    prm.add_parameter("Source", source,
                      "Source of the base acceleration. artificial: three components that match a design "
                      "spectrum. file: records from files. none: the base is at rest.",
                      Patterns::Selection("artificial|file|none"));
    prm.add_parameter(
        "Duration", duration,
        "Length of the ground motion and of the run, or of each part of Sequence [s]. Longer records are cut. Shorter records are an "
        "error. An artificial motion of another length is another motion. -1: length of the shortest record, or 20.48 s for an artificial motion. On rock, -1 extends "
        "the run by the travel time of the waves to the base of the dam, in whole time steps of the motion.",
        {0., 300.});
    prm.add_parameter(
        "Time step", time_step,
        "Sampling interval of the ground motion [s]. Duration must be a multiple of it. Records with a "
        "longer interval are interpolated linearly. Records with a shorter interval are low-pass filtered at "
        "0.5/Time step before sampling. Each component may have another interval.",
        {1e-4, .05});
    prm.add_parameter("Factor", factor, "Factor of all components [-], for every source.");
    for (unsigned int d = 0; d < 3; ++d)
      prm.add_parameter(std::string("Scale ") + names_of_axes[d], scale[d],
                        std::string("Factor [-] of the component in ") + names_of_axes[d] +
                            ", for every source. 0 switches the component off.");
    add_sequence_parameters(prm);
    add_ensemble_parameters(prm);
    add_file_parameters(prm);
    add_artificial_parameters(prm);
    prm.leave_subsection();
  }

  void MotionParameters::add_sequence_parameters(Entries &prm)
  {
    prm.add_parameter(
        "Sequence", sequence,
        "Several motions one after another, separated by semicolons, instead of File, File x, y, "
        "z or Seed. Source = file: a table as in File, or three files for x, y, z as in File x, "
        "File y, File z, separated by commas; - for a component without a file. Source = "
        "artificial: seeds, such as 1; 2.",
        Patterns::Anything());
    prm.add_parameter(
        "Rest", rest,
        "Zero acceleration after each motion [s], a multiple of Time step, in which the dam comes "
        "to rest. -1: 10 s with Sequence, otherwise 0.",
        {1., 60., true});
    prm.add_parameter(
        "Target spectrum", target_file,
        "File with the columns period [s] or frequency [Hz] and pseudo-acceleration for the damping ratio Damping, or with one "
        "pseudo-acceleration for each of x, y, z; or a uniform hazard spectrum of OpenQuake, or a search in PEER's data base. Unit of "
        "the headings, otherwise as in Unit; period 0 or at most 0.02 s first (peak acceleration), at least 3 s last. One column "
        "applies to x and y, and multiplied by Vertical ratio to z. Of several spectra, the name of one follows, as in \"uhs.csv: "
        "0.1\". It replaces the design spectrum of artificial "
        "motions, and is the target of Match.",
        Patterns::Anything());
  }

  void MotionParameters::add_ensemble_parameters(Entries &prm)
  {
    prm.add_parameter(
        "Ensemble", ensemble,
        "Several motions, each one for a separate run from the same static state, separated by semicolons as in "
        "Sequence. Source = artificial: seeds, such as 1-16 or 3; 7; 11. Source = file: files. The results are the "
        "median and the scatter. Empty: one motion.",
        Patterns::Anything());
    prm.add_parameter(
        "Ensemble factors", ensemble_factors,
        "Factors [-] of all motions of Ensemble, besides Factor, as in 0.5, 1, 1.5: incremental "
        "dynamic analysis. Empty: 1.",
        Patterns::Anything());
    prm.add_parameter(
        "Ensemble output", ensemble_output,
        "Numbers of the motions of Ensemble, such as 3, 7, whose run is written with all tables to a "
        "directory of its own. Empty: none.",
        Patterns::Anything());
  }

  void MotionParameters::add_file_parameters(Entries &prm)
  {
    prm.add_parameter(
        "File", file,
        "Source = file: table with the columns t [s], a_x, a_y, a_z, separated by blanks or "
        "commas. The text after # is a comment. Headings state the sequence of the columns. With "
        "Azimuths: table or file of an agency with one to three channels. The path is relative to "
        "the input file. Empty: File x, File y and File z are used.",
        Patterns::Anything());
    for (unsigned int d = 0; d < 3; ++d)
      prm.add_parameter(
          std::string("File ") + names_of_axes[d], component_files[d],
          std::string("Source = file: component in ") + names_of_axes[d] +
              ", as a table with the columns t [s], a, or as a file of K-NET, KiK-net, ESM, AFAD, SMC, COSMOS, CSMIP "
              "or PEER (AT2). Empty: the component is zero.",
          Patterns::Anything());
    prm.add_parameter(
        "File step", file_step,
        "Source = file: sampling interval of tables without times [s]. 0: all tables have times.",
        {1e-4, .05, true});
    prm.add_parameter(
        "Azimuths", azimuths,
        "Source = file: azimuth of the axis x, as in \"x: 120; EW: 90; NS: 0\" [degrees clockwise from north]. The "
        "horizontal channels of the files are then turned to x and y. The directions of the channels are those in "
        "the files. Other entries of the list replace them, by the name of the channel (see the log) or of the "
        "file. Empty: the channels are x, y and z.",
        Patterns::Map(Patterns::Anything(), Patterns::Double(-360., 360.), 0, Patterns::Map::max_int_value,
                      ";"));
    prm.add_parameter(
        "Abutments", abutments,
        "Source = file: other motions at the banks, as \"right Z: FILES; left Z: FILES\", with the height Z [m] "
        "of the station. FILES: one file as in File, or three files for x, y, z, separated by commas. File, or "
        "File x, y, z, is then the motion at the lowest base node. The motion of the other base nodes is "
        "interpolated linearly by height between the stations of their bank, and above the highest station it "
        "is that of the station. A record that begins at a later time is zero before. Requires "
        "Foundation/Model = massless.",
        Patterns::Map(Patterns::Anything(), Patterns::Anything(), 0, Patterns::Map::max_int_value, ";"));
    prm.add_parameter(
        "Unit", unit,
        "Unit of the acceleration in tables, and in a Target spectrum without unit, such as g (9.80665 m/s^2), m/s^2, cm/s^2 or "
        "gal. Files of agencies have their own unit.",
        Patterns::Selection(unit_choices("acceleration")));
    prm.add_parameter("Baseline", baseline,
                      "Source = file: correction of each component over its length in the run. none. linear: "
                      "the least-squares straight line of the acceleration is subtracted. quadratic: a "
                      "parabola. Both make velocity and displacement zero at the end. With Rest or Sequence "
                      "the first and the last sample become zero, too.",
                      Patterns::Selection("none|linear|quadratic"));
    prm.add_parameter(
        "Match", match,
        "Source = file: true: each component is changed in the time domain until its response spectrum agrees with Target spectrum from "
        "0.04 s to 3 s. scale: each record is multiplied by one factor, for which the horizontal spectra in Match band have the mean "
        "logarithm of the target. Factor and Scale then apply to the matched motion.",
        Patterns::Selection("false|true|scale"));
    prm.add_parameter(
        "Match band", match_band,
        "Match = scale: first and last period [s] of the comparison, as in 0.2, 2, which Target spectrum must cover. Empty: 0.04, 3.",
        Patterns::Anything());
  }

  void MotionParameters::add_artificial_parameters(Entries &prm)
  {
    prm.add_parameter("Spectrum", spectrum.code,
                      "Source = artificial: standard design spectrum. Beyond the characteristic period T_g "
                      "it decreases with (T_g/T)^0.9 (DL5073-2000) or (T_g/T)^0.6 (NB35047-2015).",
                      Patterns::Selection("DL5073-2000|NB35047-2015"));
    prm.add_parameter("Characteristic period", spectrum.characteristic_period,
                      "Source = artificial: characteristic period T_g of the site [s], at which the descent "
                      "of the spectrum begins. 0.2 s on rock.",
                      {.1, 2.});
    prm.add_parameter("Maximum beta", spectrum.maximum_beta,
                      "Source = artificial: ratio of the largest spectral acceleration to the peak "
                      "acceleration [-]. 2.5 for arch dams.",
                      {1.5, 4.});
    prm.add_parameter("Peak acceleration", peak_acceleration,
                      "Source = artificial: peak acceleration in x and in y [g].", {.005, 2.});
    prm.add_parameter(
        "Vertical ratio", vertical_ratio,
        "Source = artificial, or spectrum of a file with one column: ratio of peak and spectrum in "
        "z to those in x and y [-].",
        {.2, 1.5});
    prm.add_parameter(
        "Damping", damping,
        "Damping ratio [-] of the response spectra in spectrum.csv and floor_spectra.csv, of the "
        "design spectrum and of Target spectrum.",
        {.005, .2});
    prm.add_parameter(
        "Seed", seed,
        "Source = artificial: number [-] that selects the random phases. Equal seeds give equal motions.",
        Patterns::Integer(0));
    prm.add_parameter("Rise end", rise_end,
                      "Source = artificial: time [s] until which the envelope increases with t^2. -1: 2.5 s, "
                      "or Duration/6 if the standard envelope does not fit into Duration.");
    prm.add_parameter("Decay begin", decay_begin,
                      "Source = artificial: time [s] until which the envelope is constant. -1: 11 s, or "
                      "11/15 of Duration if the standard envelope does not fit into Duration.");
    prm.add_parameter(
        "Decay rate", decay_rate,
        "Source = artificial: rate c [1/s] of the decay exp(-c (t - Decay begin)) of the envelope. -1: 0.25, "
        "or 3.75/Duration if the standard envelope does not fit into Duration.");
    prm.add_parameter("Matching iterations", matching_iterations,
                      "Source = artificial, or Match: largest number [-] of corrections in the time domain. "
                      "They end earlier if the spectrum matches.",
                      Patterns::Integer(0, 1000));
  }

  namespace
  {
    /** Throws InputError "Motion/ENTRY is VALUE; RULE." unless @p condition is true. */
    void require(bool condition, const std::string &entry, double value, const std::string &rule)
    {
      if (condition)
        return;
      std::ostringstream message;
      message << "Motion/" << entry << " is " << value << "; " << rule << '.';
      throw InputError(message.str());
    }

    /** Throws InputError unless @p value is from @p low to @p high, also if it is not a number. */
    void require_between(double low, double high, const std::string &entry, double value,
                         const std::string &unit)
    {
      std::ostringstream rule;
      rule << "it must lie between " << low << " and " << high << unit;
      require(value >= low && value <= high, entry, value, rule.str());
    }

    /** Returns the parts of a list without blanks at their ends. */
    std::vector<std::string> split(const std::string &list, const char separator)
    {
      std::vector<std::string> parts;
      for (std::size_t begin = 0, end; begin <= list.size(); begin = end + 1)
      {
        end = std::min(list.find(separator, begin), list.size());
        const std::string part = list.substr(begin, end - begin);
        const auto        first = part.find_first_not_of(" \t"), last = part.find_last_not_of(" \t");
        parts.push_back(first == std::string::npos ? "" : part.substr(first, last - first + 1));
      }
      return parts;
    }

    void check_sequence(const MotionParameters &p)
    {
      using Parameters = MotionParameters;
      require(p.rest == Parameters::automatic || (p.rest >= 0. && p.rest <= 1e4), "Rest", p.rest,
              "it must lie between 0 and 10000 s, or be -1: automatic");
      require(std::abs(p.rest_length() / p.time_step - std::round(p.rest_length() / p.time_step)) < 1e-6,
              "Rest", p.rest_length(), "it must be a multiple of Time step");
      if (p.sequence.empty())
        return;
      require(p.rest_length() >= .999 * p.time_step, "Rest", p.rest_length(),
              "with Sequence it must be at least one Time step");
      if (!(p.file + p.component_files[0] + p.component_files[1] + p.component_files[2]).empty())
        throw InputError(
            "Motion/Sequence and Motion/File (or File x, y, z) are both given: move the file into "
            "Sequence, or remove Sequence.");
      p.parts();
    }

    /** Checks "Match" and "Target spectrum". */
    void check_target(const MotionParameters &p)
    {
      if (p.match == "scale" && (p.source == "artificial" || !p.abutments.empty()))
        throw InputError(
            "Motion/Match is scale: Motion/Source must be file (artificial motions match their spectrum), "
            "without Motion/Abutments (each record would have its own factor). Set Match to false.");
      p.band();
      if (p.source == "file" && p.match != "false" && p.target_file.empty())
        throw InputError("Motion/Match is " + p.match +
                         ", but there is no Motion/Target spectrum: give a file with "
                         "period and pseudo-acceleration, or set Match to false.");
      if (!p.has_target())
        return;
      require_between(1e-4, 0.99, "Damping", p.damping, "");
      require_between(1e-6, 100., "Vertical ratio", p.vertical_ratio,
                      "; to switch the component off, set Scale z to 0");
      if (p.source == "artificial" || p.match != "false")
        require(p.time_step <= 0.02, "Time step", p.time_step,
                p.source == "file" ? "matched records need 0.02 s or less"
                                   : "artificial motions need 0.02 s or less");
    }

    void check_files(const MotionParameters &p)
    {
      const bool components_given =
          !(p.component_files[0] + p.component_files[1] + p.component_files[2]).empty();
      if (p.source == "file" && p.file.empty() && !components_given && (p.sequence + p.ensemble).empty())
        throw InputError("Motion/Source is file, but no file is given: set Motion/File (columns t, a_x, a_y, "
                         "a_z), Motion/File x, File y, File z, Motion/Sequence or Motion/Ensemble.");
      if (p.source == "file" && !p.file.empty() && components_given)
        throw InputError("Motion/File and Motion/File x, y, z are both given: keep either the file with all "
                         "components or the files with one each.");
      if (p.source == "artificial" && (!p.file.empty() || components_given))
        throw InputError("A file is given in section Motion, but Motion/Source is artificial: set Source = "
                         "file, or remove the file.");
      require(p.file_step == 0. || (p.file_step > 0. && p.file_step < 1e3), "File step", p.file_step,
              "it must be positive, at most 1000 s, or 0: the files have times");
      if (!p.azimuths.empty() && p.azimuths.count("x") == 0)
        throw InputError(
            "Motion/Azimuths has no azimuth of the axis x. Add it, as in \"x: 120; EW: 90; NS: 0\".");
    }

    void check_artificial(const MotionParameters &p)
    {
      constexpr double most_steps = 2e5; // match_spectrum() stores 230 vectors of that length
      require(p.length() >= 0.2, "Duration", p.length(), "artificial motions need 0.2 s or more");
      require(p.length() / p.time_step <= most_steps, "Duration", p.length(),
              "artificial motions have at most 200,000 time steps: reduce it, or increase Time step");

      using Parameters = MotionParameters;
      for (const auto &entry : {std::make_pair("Rise end", p.rise_end), {"Decay begin", p.decay_begin}})
        require(entry.second == Parameters::automatic || entry.second > 0., entry.first, entry.second,
                "it must be positive, or -1: automatic");
      require(p.decay_rate == Parameters::automatic || (p.decay_rate >= 0. && p.decay_rate <= 1e3),
              "Decay rate", p.decay_rate, "it must lie between 0 and 1000 1/s, or be -1: automatic");
      const MotionEnvelope envelope = p.envelope();
      std::ostringstream   rise, decay;
      rise << "it must be later than Rise end, " << envelope.rise_end << " s";
      decay << "it must be longer than Decay begin, " << envelope.decay_begin << " s";
      require(envelope.decay_begin > envelope.rise_end, "Decay begin", envelope.decay_begin, rise.str());
      require(p.length() > envelope.decay_begin, "Duration", p.length(), decay.str());

      require_between(1e-6, 100., "Peak acceleration", p.peak_acceleration, " g");
      require_between(0.1, 3., "Characteristic period", p.spectrum.characteristic_period, " s");
      require_between(1., 100., "Maximum beta", p.spectrum.maximum_beta, "");
    }
  } // namespace

  void MotionParameters::check(const bool runs_at_rest) const
  {
    require(time_step > 0. && time_step <= 1e3, "Time step", time_step,
            "it must be positive, at most 1000 s");
    if ((source != "none" || runs_at_rest) &&
        (!duration_is_automatic() || source != "file")) // otherwise the records determine it
    {
      require(length() >= time_step, "Duration", length(),
              "it must be at least one Time step, or -1: automatic");
      require(length() / time_step <= most_steps, "Time step", time_step,
              "the motion would have more than ten million steps: increase it");
      require(std::abs(length() / time_step - n_steps()) < 1e-6 * n_steps(), "Duration", length(),
              "it must be a multiple of Time step");
    }
    require_between(-1e9, 1e9, "Factor", factor, "");
    for (unsigned int d = 0; d < 3; ++d)
      require_between(-1e9, 1e9, std::string("Scale ") + "xyz"[d], scale[d], "");
    check_files(*this);
    if (source == "none")
      return;
    check_sequence(*this);
    check_target(*this);
    if (source == "artificial")
      check_artificial(*this);
    stations();
    members();
  }

  double MotionParameters::length() const
  {
    return duration_is_automatic() ? time_step * std::floor(20.48 / time_step + 1e-9) : duration;
  }

  double MotionParameters::rest_length() const
  {
    if (rest != automatic)
      return rest;
    return sequence.empty() ? 0. : time_step * std::max(1., std::round(10. / time_step));
  }

  namespace
  {
    /** Sets the seed of a part. @p element: element of "Sequence". */
    void set_seed(MotionParameters &part, const std::string &element, const std::string &entry = "Sequence")
    {
      const char *end = element.data() + element.size();
      const auto  read = std::from_chars(element.data(), end, part.seed);
      if (read.ec != std::errc() || read.ptr != end)
        throw InputError(
            "Motion/" + entry + ": '" + element +
            "' is not a seed. With Motion/Source = artificial give whole numbers from 0, separated "
            "by semicolons, such as 1; 2" +
            (entry == "Sequence" ? "." : ", or a range such as 1-16."));
    }

    /** Sets the files of a part. @p element: element of "Sequence" or "Abutments", which @p entry names. */
    void set_files(MotionParameters &part, const std::string &element, const std::string &entry)
    {
      const std::vector<std::string> names = split(element, ',');
      if ((names.size() != 1 && names.size() != 3) || std::count(names.begin(), names.end(), "") > 0 ||
          std::count(names.begin(), names.end(), "-") == std::ptrdiff_t(names.size()))
        throw InputError("Motion/" + entry + ": '" + element +
                         "' is neither one file with t, a_x, a_y, a_z nor three files for x, y, z (- for a "
                         "component at rest), separated by commas. Semicolons separate the motions.");
      if (names.size() == 1)
        part.file = names[0];
      else
        for (unsigned int d = 0; d < 3; ++d)
          part.component_files[d] = names[d] == "-" ? "" : names[d];
    }
  } // namespace

  std::vector<MotionParameters> MotionParameters::parts() const
  {
    if (sequence.empty())
      return {*this};
    std::vector<MotionParameters> result;
    for (const std::string &element : split(sequence, ';'))
    {
      MotionParameters part = *this;
      part.sequence.clear();
      if (source == "artificial")
        set_seed(part, element);
      else
        set_files(part, element, "Sequence");
      result.push_back(part);
    }
    return result;
  }

  namespace
  {
    constexpr std::size_t most_members = 10000; ///< motions of "Ensemble", with all factors

    /** Returns the elements of "Ensemble", with each range of seeds as single seeds. */
    std::vector<std::string> elements_of_ensemble(const MotionParameters &p)
    {
      std::vector<std::string> result;
      for (const std::string &element : split(p.ensemble, ';'))
      {
        const auto dash = element.find('-', 1);
        if (p.source != "artificial" || dash == std::string::npos)
        {
          result.push_back(element);
          continue;
        }
        MotionParameters first = p, last = p;
        set_seed(first, split(element.substr(0, dash), ';')[0], "Ensemble");
        set_seed(last, split(element.substr(dash + 1), ';')[0], "Ensemble");
        if (last.seed < first.seed || last.seed - first.seed >= most_members)
          throw InputError("Motion/Ensemble: the range '" + element + "' is empty or has more than " +
                           std::to_string(most_members) + " seeds. Write the smaller seed first.");
        for (unsigned int k = 0; k <= last.seed - first.seed; ++k)
          result.push_back(std::to_string(first.seed + k));
      }
      return result;
    }

    /** Returns the numbers of a list that commas separate. @p entry names the list. */
    std::vector<double> numbers_of(const std::string &list, const std::string &entry, const double low,
                                   const double high)
    {
      std::vector<double> result;
      for (const std::string &element : split(list, ','))
      {
        double             value = 0.;
        std::istringstream in(element);
        std::string        more;
        if (!(in >> value) || in >> more || !(value >= low && value <= high))
          throw InputError("Motion/" + entry + ": '" + element + "' is not a number from " +
                           number_text(low) + " to " + number_text(high) +
                           ". Separate the numbers by commas.");
        if (std::count(result.begin(), result.end(), value) > 0)
          throw InputError("Motion/" + entry + " has " + element + " twice. Remove one of them.");
        result.push_back(value);
      }
      return result;
    }

    /** Returns the motion of an element of "Ensemble". */
    EnsembleMember member_of(const MotionParameters &p, const std::string &element)
    {
      EnsembleMember    member{"", 1., p, {}};
      MotionParameters &motion = member.motion;
      for (const auto &[entry, value] : {std::make_pair("Motion/Ensemble", &motion.ensemble),
                                         {"Motion/Ensemble factors", &motion.ensemble_factors},
                                         {"Motion/Ensemble output", &motion.ensemble_output}})
      {
        value->clear();
        member.entries[entry] = "";
      }
      if (p.source == "artificial")
      {
        set_seed(motion, element, "Ensemble");
        member.entries["Motion/Seed"] = std::to_string(motion.seed);
      }
      else
      {
        set_files(motion, element, "Ensemble");
        member.entries["Motion/File"] = motion.file;
        for (unsigned int d = 0; d < 3; ++d)
          member.entries[std::string("Motion/File ") + names_of_axes[d]] = motion.component_files[d];
      }
      member.name = motion.name_of_part();
      return member;
    }

    void check_ensemble(const MotionParameters &p)
    {
      const std::string files = p.file + p.component_files[0] + p.component_files[1] + p.component_files[2];
      if (p.source == "none")
        throw InputError(
            "Motion/Ensemble requires motions, but Motion/Source is none. Set Source to artificial or file.");
      if (!p.sequence.empty() || !p.abutments.empty())
        throw InputError(
            std::string("Motion/Ensemble and Motion/") + (p.sequence.empty() ? "Abutments" : "Sequence") +
            " are both given. Each motion of Ensemble is one motion for the whole base. Remove one of the entries.");
      if (!files.empty())
        throw InputError(
            "Motion/Ensemble and Motion/File (or File x, y, z) are both given: move the file into "
            "Ensemble, or remove Ensemble.");
    }
  } // namespace

  std::vector<EnsembleMember> MotionParameters::members() const
  {
    if (ensemble.empty())
    {
      if (!(ensemble_factors + ensemble_output).empty())
        throw InputError("Motion/Ensemble factors and Ensemble output require Motion/Ensemble, such as 1-16. "
                         "Give it, or remove them.");
      return {};
    }
    check_ensemble(*this);
    const std::vector<std::string> elements = elements_of_ensemble(*this);
    const std::vector<double>      factors = ensemble_factors.empty()
                                                 ? std::vector<double>{1.}
                                                 : numbers_of(ensemble_factors, "Ensemble factors", 1e-6, 1e6);
    std::vector<EnsembleMember>    result;
    std::map<std::string, bool>    names;
    for (const double factor_of_all : factors)
      for (const std::string &element : elements)
      {
        EnsembleMember member = member_of(*this, element);
        member.factor = factor_of_all;
        member.motion.factor *= factor_of_all;
        std::ostringstream product;
        product.precision(17);
        product << member.motion.factor;
        member.entries["Motion/Factor"] = product.str();
        if (factor_of_all == factors[0] && !names.emplace(member.name, true).second)
          throw InputError("Motion/Ensemble has " + member.name + " twice. Remove one of them.");
        result.push_back(member);
      }
    if (result.size() > most_members)
      throw InputError("Motion/Ensemble with Ensemble factors has " + std::to_string(result.size()) +
                       " motions, more than " + std::to_string(most_members) + ". Reduce their number.");
    if (!ensemble_output.empty())
      for (const double number : numbers_of(ensemble_output, "Ensemble output", 1., result.size()))
      {
        if (number != std::floor(number))
          throw InputError("Motion/Ensemble output: " + number_text(number) + " is no whole number.");
        result[std::size_t(number) - 1].has_output = true;
      }
    return result;
  }

  std::array<double, 2> MotionParameters::band() const
  {
    if (match_band.empty() || match != "scale")
      return {{MotionCriteria::first_period, MotionCriteria::last_period}};
    const std::vector<double> periods = numbers_of(match_band, "Match band", .01, 100.);
    if (periods.size() != 2 || periods[0] > periods[1])
      throw InputError("Motion/Match band is " + match_band +
                       ". Give two periods in s, the shorter one first, as in 0.2, 2.");
    return {{periods[0], periods[1]}};
  }

  std::vector<StationParameters> MotionParameters::stations() const
  {
    std::vector<StationParameters> result;
    if (!abutments.empty() && (source != "file" || !sequence.empty()))
      throw InputError("Motion/Abutments requires Motion/Source = file, without Motion/Sequence. Remove "
                       "Abutments, or give the motion by Motion/File or File x, y, z.");
    for (const auto &[name, files] : abutments)
    {
      const bool         is_left = name.rfind("left ", 0) == 0;
      std::istringstream height(name.substr(std::min(name.size(), name.find(' '))));
      std::string        more;
      double             z;
      if ((!is_left && name.rfind("right ", 0) != 0) || !(height >> z) || height >> more)
        throw InputError("Motion/Abutments: '" + name +
                         "' is no station. Write the bank and the height in m, as in \"right 95: "
                         "right.csv; left 95: left.csv\".");
      MotionParameters record = *this;
      record.abutments.clear();
      record.file.clear();
      record.component_files = {};
      set_files(record, files, "Abutments");
      result.push_back({name, is_left, z, record});
    }
    return result;
  }

  std::string MotionParameters::name_of_part() const
  {
    if (source == "artificial")
      return "seed " + std::to_string(seed);
    std::string name = file;
    for (const std::string &component : component_files)
      if (!component.empty())
        name += (name.empty() ? "" : ", ") + component;
    return "'" + name + "'";
  }

  std::string MotionParameters::read_target(const std::string &scene_directory)
  {
    if (!has_target() || target_file.empty())
      return "";
    target_spectrum =
        read_spectrum((std::filesystem::path(scene_directory) / target_file).string(), unit, vertical_ratio,
                      match == "scale" && source == "file"
                          ? PeriodRange{band()[0], band()[1], ", or change Motion/Match band"}
                          : PeriodRange{.02, MotionCriteria::last_period});
    if (const double of_file = target_spectrum.damping; of_file > 0. && std::abs(of_file - damping) > 1e-6)
      throw InputError("The spectrum '" + target_file + "' is for a damping ratio of " +
                       number_text(of_file) + ", but Motion/Damping is " + number_text(damping) +
                       ". Set Motion/Damping = " + number_text(of_file) + ", or give another spectrum.");
    return "target spectrum '" + target_file + "': " + target_spectrum.note;
  }

  void MotionParameters::add_choices(ModelChoices &choices) const
  {
    const auto moves = [&](const unsigned int d)
    {
      const bool in_file = source == "file" && (file + sequence + ensemble).empty() && abutments.empty() &&
                           component_files[d].empty();
      return source != "none" && factor != 0. && scale[d] != 0. && !in_file;
    };
    if (!abutments.empty())
      choices.add("motion", "banks move as the base", {{"Motion/Abutments", ""}}, true);
    if (moves(1))
      choices.add("motion", "without the cross-stream component", "Motion/Scale y", 0., true);
    if (moves(2))
      choices.add("motion", "without the vertical component", "Motion/Scale z", 0., true);
  }

  MotionEnvelope MotionParameters::envelope() const
  {
    const auto choose = [](double given, double otherwise) { return given == automatic ? otherwise : given; };
    const auto scaled = [&](double scale) -> MotionEnvelope
    {
      return {choose(rise_end, 2.5 * scale), choose(decay_begin, 11. * scale),
              choose(decay_rate, 0.25 / scale)};
    };
    const auto fits = [&](const MotionEnvelope &e)
    { return e.decay_begin > e.rise_end && length() > e.decay_begin; };
    MotionEnvelope result = scaled(1.);
    if (!fits(result))
      result = scaled(std::min(1., length() / 15.));
    if (!fits(result) && decay_begin == automatic) // rise_end is given and late
      result.decay_begin = .5 * (result.rise_end + length());
    return result;
  }

  unsigned int MotionParameters::n_steps() const
  {
    return std::lround(length() / time_step);
  }

  double MotionParameters::target(unsigned int direction, double period) const
  {
    if (!target_spectrum.periods.empty())
      return target_spectrum.at(direction, period);
    const double peak = standard_gravity * peak_acceleration * (direction == 2 ? vertical_ratio : 1.);
    const double beyond = std::max(period / MotionCriteria::last_period, 1.);
    return peak * design_beta(spectrum, period) / (beyond * beyond);
  }
} // namespace Voussoir
