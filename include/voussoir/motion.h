#ifndef voussoir_motion_h
#define voussoir_motion_h

#include <array>
#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

#include <voussoir/design_spectrum.h>

namespace dealii
{
  class ParameterHandler;
}

namespace Voussoir
{
  /** Acceleration of the base in the axes of the scene: x downstream, y across the valley, z up. */
  struct GroundMotion
  {
    double                             dt = 0.01;    ///< sampling interval [s]
    std::vector<std::array<double, 3>> acceleration; ///< a_x, a_y, a_z [m/s^2] at t = k dt

    double                duration() const;   ///< time of the last sample [s]
    std::array<double, 3> at(double t) const; ///< linear interpolation; zero outside the record
    std::vector<double>   component(unsigned int direction) const; ///< 0, 1, 2 for x, y, z
  };

  /** Standard gravity, for accelerations given in g [m/s^2]. */
  constexpr double standard_gravity = 9.80665;

  /** Section "Motion" of a scene. */
  struct MotionParameters
  {
    std::string           source = "artificial"; ///< or "file", "none"
    double                duration = 20.48;      ///< [s]
    double                time_step = 0.01;      ///< [s]
    std::array<double, 3> scale = {{1., 1., 1.}};

    // Source = file. Paths are relative to the scene's directory.
    std::string                file;            ///< one file with t, a_x, a_y, a_z,
    std::array<std::string, 3> component_files; ///< or one for each component, with t, a, or AT2
    std::string                unit = "m/s^2";
    double                     factor = 1.;

    // Source = artificial
    DesignSpectrum spectrum;
    double         peak_acceleration = 0.5575; ///< horizontal [g]
    double         vertical_ratio = 0.666667;  ///< vertical to horizontal
    double         damping = 0.05;
    unsigned int   seed = 1;
    double         rise_end = 2.5;    ///< [s]
    double         decay_begin = 11.; ///< [s]
    double         decay_rate = 0.25; ///< [1/s]
    unsigned int   matching_iterations = 20;

    void add_parameters(dealii::ParameterHandler &prm);
    void check() const; ///< throws InputError, naming the entry

    unsigned int n_steps() const; ///< duration / time_step

    /** What an artificial motion is to match: pseudo-acceleration [m/s^2] in a direction at a period [s];
     *  at period zero the peak acceleration. Beyond 3 s, where the codes end, the displacement spectrum is
     *  constant. Without "Scale". */
    double target(unsigned int direction, double period) const;
  };

  /** The motion of a scene, with n_steps() + 1 samples.
   *
   *  file: read, converted to m/s^2, interpolated linearly to the analysis' time step, and cut at
   *  "Duration"; an absent component is zero. A record that cannot be read or is too short is an
   *  InputError. artificial: three components by make_artificial_component(), whose mutual correlations are
   *  at most 0.3. none: zeros. All are multiplied by "Scale x", "Scale y", "Scale z". */
  GroundMotion make_motion(const MotionParameters &parameters, const std::string &scene_directory);

  /** Where artificial motions are to match, and how well: Chinese hydraulic practice. */
  namespace MotionCriteria
  {
    constexpr double first_period = 0.04, last_period = 3.; ///< [s]
    constexpr double maximum_error = 0.10, mean_error = 0.05, correlation = 0.3;
  } // namespace MotionCriteria

  /** Engineering measures of a motion. Velocity and displacement are the exact integrals of the
   *  piecewise linear acceleration from rest. */
  struct MotionReport
  {
    struct Component
    {
      double peak_acceleration = 0.;    ///< [m/s^2]
      double peak_velocity = 0.;        ///< [m/s]
      double peak_displacement = 0.;    ///< [m]
      double arias_intensity = 0.;      ///< pi / (2 g) times the integral of a^2 [m/s]
      double significant_duration = 0.; ///< from 5 % to 95 % of it (D5-95) [s]
      double end_velocity = 0.;         ///< [m/s]
      double end_displacement = 0.;     ///< [m]
      double maximum_error = 0.;        ///< of the pseudo-acceleration, relative to the target; artificial
      double mean_error = 0.;           ///< of its magnitude, over the periods; artificial
    };
    std::array<Component, 3> components;
    /// Of the accelerations: x with y, x with z, y with z.
    std::array<double, 3> correlations = {{0., 0., 0.}};
    bool                  artificial = false;
  };

  /** Errors are taken of artificial motions only, over 0.04 s to 3 s at 200 periods per decade; at each
   * period the greater of two, that of the true peak and that of the peak seen at the samples alone. */
  MotionReport report_motion(const GroundMotion &motion, const MotionParameters &parameters);

  /** A table, then a warning for each criterion of MotionCriteria that an artificial motion misses. */
  void print_report(const MotionReport &report, std::ostream &out);

  /** CSV with the header `t,a_x,a_y,a_z` [s, m/s^2], as make_motion() reads it. InputError if the file
   *  cannot be written. */
  void write_motion(const GroundMotion &motion, const std::string &file);
} // namespace Voussoir

#endif
