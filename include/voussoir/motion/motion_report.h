// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_motion_report_h
#define voussoir_motion_report_h

#include <voussoir/motion/ground_motion.h>
#include <voussoir/motion/motion_parameters.h>

#include <iosfwd>

namespace Voussoir
{
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

  /** A motion that is no earthquake: peak acceleration beyond 0.005 to 2 g, velocity above 5 m/s or
   * displacement above 10 m; empty if it is one. */
  std::string size_warning(const MotionReport &report);

  /** A sentence for each criterion of MotionCriteria that the motion misses, and of its size. */
  std::vector<std::string> motion_warnings(const MotionReport &report);

  /** That of the end alone (MotionCriteria::end_displacement, end_velocity); empty if it is met. */
  std::string end_warning(const MotionReport &report);

  /** A table, then the warnings. */
  void print_report(const MotionReport &report, std::ostream &out);
} // namespace Voussoir

#endif
