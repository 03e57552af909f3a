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
    std::vector<std::string>           notes;        ///< what was done to records, for the user

    double                duration() const;   ///< time of the last sample [s]
    std::array<double, 3> at(double t) const; ///< linear interpolation; zero outside the record
    std::vector<double>   component(unsigned int direction) const; ///< 0, 1, 2 for x, y, z
  };

  /** Standard gravity, for accelerations given in g [m/s^2]. */
  constexpr double standard_gravity = 9.80665;

  /** Envelope of an artificial motion: t^2, then one, then exp(-decay_rate (t - decay_begin)). */
  struct MotionEnvelope
  {
    double rise_end, decay_begin; ///< [s]
    double decay_rate;            ///< [1/s]
  };

  /** Section "Motion" of a scene. */
  struct MotionParameters
  {
    static constexpr double automatic = -1.; ///< of entries that follow from others
    static constexpr double most_steps = 1e7;

    std::string           source = "artificial";  ///< or "file", "none"
    double                duration = automatic;   ///< [s]; see length()
    double                time_step = 0.01;       ///< [s]
    double                factor = 1.;            ///< on all components, whatever the source
    std::array<double, 3> scale = {{1., 1., 1.}}; ///< on one each

    // Source = file. Paths are relative to the scene's directory.
    std::string                file;            ///< one file with t, a_x, a_y, a_z,
    std::array<std::string, 3> component_files; ///< or one for each component, with t, a, or AT2
    std::string                unit = "m/s^2";

    // Source = artificial
    DesignSpectrum spectrum;
    double         peak_acceleration = 0.5575; ///< horizontal [g]
    double         vertical_ratio = 0.666667;  ///< vertical to horizontal
    double         damping = 0.05;
    unsigned int   seed = 1;
    double         rise_end = automatic;    ///< [s]; see envelope()
    double         decay_begin = automatic; ///< [s]
    double         decay_rate = automatic;  ///< [1/s]
    unsigned int   matching_iterations = 20;

    void add_parameters(dealii::ParameterHandler &prm);
    void check() const; ///< throws InputError, naming the entry

    bool         duration_is_automatic() const { return duration == automatic; }
    double       length() const;  ///< "Duration", or 20.48 s where it is automatic, but for records [s]
    unsigned int n_steps() const; ///< length() / time_step

    /** As the entries say; those that are automatic: 2.5 s, 11 s and 0.25 1/s where the motion is longer than
     * that, else the envelope of a motion of 15 s in the time scale length()/15 s. */
    MotionEnvelope envelope() const;

    /** What an artificial motion is to match: pseudo-acceleration [m/s^2] in a direction at a period [s];
     *  at period zero the peak acceleration. Beyond 3 s, where the codes end, the displacement spectrum is
     *  constant. Without "Scale". */
    double target(unsigned int direction, double period) const;
  };

  /** The motion of a scene.
   *
   *  file: read_motion(); an absent component is zero. artificial: three components by
   *  make_artificial_component(), whose mutual correlations are at most 0.3. none: zeros. All are multiplied
   * by "Factor" and "Scale x", "Scale y", "Scale z". InputError where a record or an entry is not usable, and
   * where a sample is not finite or above 1000 g. */
  GroundMotion make_motion(const MotionParameters &parameters, const std::string &scene_directory);

  /** Where artificial motions are to match, and how well: Chinese hydraulic practice. */
  namespace MotionCriteria
  {
    constexpr double first_period = 0.04, last_period = 3.; ///< [s]
    constexpr double maximum_error = 0.10, mean_error = 0.05, correlation = 0.3;

    /** At the end of a motion, over the peaks. Records that were corrected, and artificial ones, come back to
     * rest within a few per cent. What remains above these is an uncorrected baseline, a record that is cut
     * while it shakes, or a permanent displacement of the ground; on rock (absolute displacements) the dam
     * goes with it, and a velocity that remains carries it on. */
    constexpr double end_displacement = 0.2, end_velocity = 0.1;
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

  /** A sentence for each criterion of MotionCriteria that the motion misses. */
  std::vector<std::string> motion_warnings(const MotionReport &report);

  /** That of the end alone (MotionCriteria::end_displacement, end_velocity); empty if it is met. */
  std::string end_warning(const MotionReport &report);

  /** A table, then the warnings. */
  void print_report(const MotionReport &report, std::ostream &out);

  /** CSV with the header `t,a_x,a_y,a_z` [s, m/s^2], as make_motion() reads it. Throws WriteError. */
  void write_motion(const GroundMotion &motion, const std::string &file);
} // namespace Voussoir

#endif
