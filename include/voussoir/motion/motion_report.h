// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_motion_report_h
#define voussoir_motion_report_h

#include <voussoir/motion/ground_motion.h>
#include <voussoir/motion/motion_parameters.h>

#include <iosfwd>

namespace Voussoir
{
  /** Engineering measures of a ground motion. Velocity and displacement are the exact integrals of the
   * piecewise linear acceleration, from rest. */
  struct MotionReport
  {
    struct Component
    {
      double peak_acceleration = 0.;    ///< [m/s^2]
      double peak_velocity = 0.;        ///< [m/s]
      double peak_displacement = 0.;    ///< [m]
      double arias_intensity = 0.;      ///< pi / (2 g) times the time integral of a^2 [m/s]
      double significant_duration = 0.; ///< from 5 % to 95 % of the Arias intensity (D5-95) [s]
      double end_velocity = 0.;         ///< [m/s]
      double end_displacement = 0.;     ///< [m]
      double maximum_error = 0.;        ///< SpectralError::maximum; 0 without target spectrum
      double mean_error = 0.;           ///< SpectralError::mean; 0 without target spectrum
    };
    std::array<Component, 3> components; ///< x, y, z
    /// Correlation coefficients of the accelerations: x-y, x-z, y-z [-].
    std::array<double, 3> correlations = {{0., 0., 0.}};
    bool                  artificial = false; ///< the motion is artificial
    bool                  matched = false;    ///< record with "Match"
    bool                  has_target = false; ///< there is a target spectrum
  };

  /** Computes the measures of a ground motion. With a target spectrum, spectral_error() is evaluated from
   * 0.04 s to 3 s with 200 periods per decade, for components that are not zero.
   * Of a sequence the largest errors of its parts are reported.
   * @param motion of make_motion(), with "Factor" and "Scale"
   * @param parameters section "Motion" */
  MotionReport report_motion(const GroundMotion &motion, const MotionParameters &parameters);

  /** Returns a warning about an unusual size of the motion: peak acceleration outside 0.005 to 2 g, peak
   * velocity above 5 m/s, or peak displacement above 10 m. Returns an empty string otherwise. */
  std::string size_warning(const MotionReport &report);

  /** Returns one warning for each criterion of MotionCriteria that the motion does not satisfy, and one if
   * its size is unusual (size_warning()). */
  std::vector<std::string> motion_warnings(const MotionReport &report);

  /** Returns a warning if the motion does not end at rest (MotionCriteria::end_displacement, end_velocity).
   * Returns an empty string otherwise. */
  std::string end_warning(const MotionReport &report);

  /** Prints response spectra of the components, RotD50 and RotD100 of x and y, and the target of x at nine periods.
   * The arguments are those of report_motion(). */
  void print_spectra(const GroundMotion &motion, const MotionParameters &parameters, std::ostream &out);

  /** Prints a table of the measures, and then the warnings. */
  void print_report(const MotionReport &report, std::ostream &out);
} // namespace Voussoir

#endif
