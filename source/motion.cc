#include <deal.II/base/parameter_handler.h>

#include <voussoir/error.h>
#include <voussoir/motion.h>
#include <voussoir/motion_artificial.h>
#include <voussoir/motion_record.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace Voussoir
{
  double GroundMotion::duration() const
  {
    return acceleration.empty() ? 0. : dt * (acceleration.size() - 1);
  }

  std::array<double, 3> GroundMotion::at(double t) const
  {
    std::array<double, 3> a = {{0., 0., 0.}};
    // Times are often sums of time steps: rounding must not lose the last sample.
    const double position = t / dt, last = double(acceleration.size()) - 1., rounding = 1e-9 * last;
    if (!(position >= 0.) || position > last + rounding)
      return a;
    const std::size_t k = std::min<std::size_t>(position, acceleration.size() - 1);
    const std::size_t next = std::min(k + 1, acceleration.size() - 1);
    for (unsigned int d = 0; d < 3; ++d)
      a[d] = acceleration[k][d] + (position - k) * (acceleration[next][d] - acceleration[k][d]);
    return a;
  }

  std::vector<double> GroundMotion::component(unsigned int direction) const
  {
    std::vector<double> a;
    for (const auto &sample : acceleration)
      a.push_back(sample[direction]);
    return a;
  }

  void MotionParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    namespace Patterns = dealii::Patterns;
    const char *const names[] = {"x", "y", "z"};

    prm.enter_subsection("Motion");
    prm.add_parameter(
        "Source", source,
        "Where the acceleration of the base comes from: 'artificial' makes three components that "
        "match a design spectrum, 'file' reads records, 'none' leaves the base at rest.",
        Patterns::Selection("artificial|file|none"));
    prm.add_parameter("Duration", duration, "Length of the shaking [s]. Longer records are cut.");
    prm.add_parameter(
        "Time step", time_step,
        "Sampling interval of the motion [s]; Duration is a multiple of it. Records with another "
        "interval are interpolated linearly.");
    for (unsigned int d = 0; d < 3; ++d)
      prm.add_parameter(std::string("Scale ") + names[d], scale[d],
                        std::string("Factor [-] on the component in ") + names[d] +
                            ", whatever its source; 0 switches it off.");

    prm.add_parameter(
        "File", file,
        "Source = file: a table with the columns t [s], a_x, a_y, a_z, separated by blanks or commas; "
        "lines may end in # comments. The path is relative to the scene file. Leave it empty to "
        "give File x, File y, File z.",
        Patterns::Anything());
    for (unsigned int d = 0; d < 3; ++d)
      prm.add_parameter(
          std::string("File ") + names[d], component_files[d],
          std::string("Source = file: the component in ") + names[d] +
              ", a table with the columns t [s], a or a PEER AT2 file. If empty, this component is zero.",
          Patterns::Anything());
    prm.add_parameter(
        "Unit", unit,
        "Source = file: unit of acceleration in tables, 'g' = 9.80665 m/s^2, 'm/s^2' or 'cm/s^2'. AT2 "
        "files are always in g.",
        Patterns::Selection("g|m/s^2|cm/s^2"));
    prm.add_parameter("Factor", factor, "Source = file: factor [-] on all components, for scaling records.");

    prm.add_parameter(
        "Spectrum", spectrum.code,
        "Source = artificial: the standard design spectrum; beyond the characteristic period T_g "
        "it descends with (T_g/T)^0.9 in DL5073-2000 and with (T_g/T)^0.6 in NB35047-2015.",
        Patterns::Selection("DL5073-2000|NB35047-2015"));
    prm.add_parameter(
        "Characteristic period", spectrum.characteristic_period,
        "Source = artificial: period T_g [s] of the site where the spectrum begins to descend; 0.2 "
        "on rock.");
    prm.add_parameter(
        "Maximum beta", spectrum.maximum_beta,
        "Source = artificial: largest spectral acceleration over peak acceleration [-]; 2.5 for arch "
        "dams.");
    prm.add_parameter("Peak acceleration", peak_acceleration, "Source = artificial: in x and in y [g].");
    prm.add_parameter("Vertical ratio", vertical_ratio,
                      "Source = artificial: peak and spectrum in z over those in x and y [-].");
    prm.add_parameter("Damping", damping, "Source = artificial: damping ratio [-] of the spectrum.");
    prm.add_parameter(
        "Seed", seed,
        "Source = artificial: number [-] that selects the random phases; equal seeds give equal "
        "motions.");
    prm.add_parameter("Rise end", rise_end,
                      "Source = artificial: the envelope rises as t^2 until this time [s].");
    prm.add_parameter("Decay begin", decay_begin,
                      "Source = artificial: the envelope is constant until this time [s].");
    prm.add_parameter("Decay rate", decay_rate,
                      "Source = artificial: c [1/s] of the envelope's decay exp(-c (t - Decay begin)).");
    prm.add_parameter(
        "Matching iterations", matching_iterations,
        "Source = artificial: largest number [-] of corrections in the time domain; they end earlier "
        "when the spectrum matches.");
    prm.leave_subsection();
  }

  void MotionParameters::check() const
  {
    const auto require = [](bool condition, const char *entry, double value, const char *rule)
    {
      if (condition)
        return;
      std::ostringstream message;
      message << "Motion/" << entry << " is " << value << "; " << rule << '.';
      throw InputError(message.str());
    };

    require(time_step > 0., "Time step", time_step, "it must be positive");
    require(duration >= time_step, "Duration", duration, "it must be at least one Time step");
    require(duration / time_step <= 1e7, "Time step", time_step, "more than ten million steps: enlarge it");
    require(std::abs(duration / time_step - n_steps()) < 1e-6 * n_steps(), "Duration", duration,
            "it must be a multiple of Time step");

    const bool components_given = !(component_files[0] + component_files[1] + component_files[2]).empty();
    if (source == "file" && file.empty() && !components_given)
      throw InputError(
          "Motion/Source is file, but no file is given: set Motion/File (columns t, a_x, a_y, a_z) "
          "or Motion/File x, File y, File z.");
    if (source == "file" && !file.empty() && components_given)
      throw InputError("Motion/File and Motion/File x, y, z are both given: keep either the file with all "
                       "components or the files with one each.");
    if (source == "artificial" && (!file.empty() || components_given))
      throw InputError(
          "A file is given in section Motion, but Motion/Source is artificial: set Source = file, "
          "or remove the file.");

    if (source == "artificial")
    {
      require(time_step <= 0.02, "Time step", time_step, "artificial motions need 0.02 s or less");
      require(rise_end > 0., "Rise end", rise_end, "it must be positive");
      require(decay_begin > rise_end, "Decay begin", decay_begin, "it must be later than Rise end");
      require(duration > decay_begin, "Duration", duration, "it must be longer than Decay begin");
      require(decay_rate >= 0., "Decay rate", decay_rate, "it must not be negative");
      require(damping > 0. && damping < 1., "Damping", damping, "it must lie between 0 and 1");
      require(peak_acceleration > 0., "Peak acceleration", peak_acceleration, "it must be positive");
      require(vertical_ratio > 0., "Vertical ratio", vertical_ratio,
              "it must be positive; to switch the component off, set Scale z to 0");
      require(spectrum.characteristic_period >= 0.1 && spectrum.characteristic_period <= 3.,
              "Characteristic period", spectrum.characteristic_period, "it must lie between 0.1 s and 3 s");
      require(spectrum.maximum_beta >= 1., "Maximum beta", spectrum.maximum_beta, "it must be at least 1");
    }
  }

  unsigned int MotionParameters::n_steps() const
  {
    return std::lround(duration / time_step);
  }

  double MotionParameters::target(unsigned int direction, double period) const
  {
    const double peak = standard_gravity * peak_acceleration * (direction == 2 ? vertical_ratio : 1.);
    const double beyond = std::max(period / MotionCriteria::last_period, 1.);
    return peak * design_beta(spectrum, period) / (beyond * beyond);
  }

  namespace
  {
    GroundMotion read_motion(const MotionParameters &parameters, const std::string &scene_directory)
    {
      GroundMotion motion;
      motion.dt = parameters.time_step;
      motion.acceleration.resize(parameters.n_steps() + 1, {{0., 0., 0.}});

      const double unit = parameters.unit == "g" ? standard_gravity : parameters.unit == "cm/s^2" ? 0.01 : 1.;

      // Components first, first + 1, ... from one file.
      const auto read = [&](const std::string &name, unsigned int first, unsigned int n_components)
      {
        const std::string  path = (std::filesystem::path(scene_directory) / name).string();
        const MotionRecord record = read_motion_record(path, n_components);
        if (record.duration() < parameters.duration - 0.01 * record.dt)
        {
          std::ostringstream message;
          message << "The ground motion file '" << path << "' lasts " << record.duration()
                  << " s, less than Motion/Duration, " << parameters.duration
                  << " s. Set Duration to at most " << record.duration()
                  << " s (a multiple of Time step), or give a longer record.";
          throw InputError(message.str());
        }
        const double factor = parameters.factor * (record.in_g ? standard_gravity : unit);
        for (std::size_t k = 0; k < motion.acceleration.size(); ++k)
          for (unsigned int c = 0; c < n_components; ++c)
            motion.acceleration[k][first + c] = factor * record.at(c, k * motion.dt);
        return record.start;
      };

      if (!parameters.file.empty())
      {
        read(parameters.file, 0, 3);
        return motion;
      }
      std::vector<double> starts;
      for (unsigned int d = 0; d < 3; ++d)
        if (!parameters.component_files[d].empty())
        {
          starts.push_back(read(parameters.component_files[d], d, 1));
          if (std::abs(starts.back() - starts.front()) > 1e-6)
            throw InputError("The ground motion file '" + parameters.component_files[d] + "' starts at " +
                             std::to_string(starts.back()) + " s, the component before it at " +
                             std::to_string(starts.front()) + " s. Cut the records to the same first time.");
        }
      return motion;
    }
  } // namespace

  GroundMotion make_motion(const MotionParameters &parameters, const std::string &scene_directory)
  {
    parameters.check();

    GroundMotion motion;
    if (parameters.source == "artificial")
      motion = make_artificial_motion(parameters);
    else if (parameters.source == "file")
      motion = read_motion(parameters, scene_directory);
    else
    {
      motion.dt = parameters.time_step;
      motion.acceleration.resize(parameters.n_steps() + 1, {{0., 0., 0.}});
    }
    for (auto &sample : motion.acceleration)
      for (unsigned int d = 0; d < 3; ++d)
        sample[d] *= parameters.scale[d];
    return motion;
  }

  void write_motion(const GroundMotion &motion, const std::string &file)
  {
    std::ofstream out(file);
    out << "t,a_x,a_y,a_z\n" << std::setprecision(12);
    for (std::size_t k = 0; k < motion.acceleration.size(); ++k)
    {
      out << k * motion.dt;
      for (const double a : motion.acceleration[k])
        out << ',' << a;
      out << '\n';
    }
    out.close();
    if (!out)
      throw InputError("The ground motion cannot be written to '" + file +
                       "': does the directory exist, is it writable, is the disk full?");
  }
} // namespace Voussoir
