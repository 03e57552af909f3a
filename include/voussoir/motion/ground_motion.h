// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_ground_motion_h
#define voussoir_ground_motion_h

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace Voussoir
{
  /** Velocity [m/s] and displacement [m] of a ground motion at its samples, x, y, z. Both are zero at the
   * first sample. */
  struct MotionIntegrals
  {
    std::vector<std::array<double, 3>> velocity, displacement;
  };

  /** Part of a ground motion: one record or one artificial motion of "Motion/Sequence". */
  struct MotionPart
  {
    std::string name;       ///< files, or seed
    double      begin, end; ///< times of its first and last sample [s]. The rest follows.
  };

  /** Record before and after "Motion/Match". The misfit is the root of the mean square of ln(spectrum / target) over
   * the horizontal components and MotionParameters::band(), at equal ratios of the periods. */
  struct TargetFit
  {
    double factor = 1.; ///< of "scale", see process_record() [-]
    double misfit_before = std::nan(""), misfit_after = std::nan(""); ///< [-]; NaN without "Match"
  };

  /** Record at one bank of the valley, of the same length as the ground motion. */
  struct MotionStation
  {
    bool                               is_left;      ///< true: left bank (y > 0)
    double                             height;       ///< z [m]
    std::vector<std::array<double, 3>> acceleration; ///< as in GroundMotion [m/s^2]
  };

  /** Ground motion: acceleration of the base in the axes of the program. x points downstream, y to the left
   * bank, z up. The acceleration is linear between the samples. */
  struct GroundMotion
  {
    double                             dt = 0.01;    ///< sampling interval [s]
    std::vector<std::array<double, 3>> acceleration; ///< a_x, a_y, a_z [m/s^2] at t = k dt
    std::vector<std::string>           notes; ///< processing of records (duration, filter), for the log
    std::vector<MotionPart>            parts; ///< one after another; make_motion() sets them
    TargetFit                          fit;   ///< of the last part
    std::vector<MotionStation> stations; ///< other motions at the banks, "Motion/Abutments"; empty: the same

    /** Returns the time of the last sample [s]. */
    double duration() const;

    /** Returns the acceleration at t = @p k dt [m/s^2]. It is zero after the last sample. */
    std::array<double, 3> sample(std::size_t k) const;

    /** Returns the time at which the rest after a part ends [s]: the beginning of the next part, or the end of
     * the motion. */
    double end_of_rest(std::size_t part) const;

    /** Returns all samples of one component [m/s^2]. @p direction: 0, 1 or 2 for x, y or z. */
    std::vector<double> component(unsigned int direction) const;

    /** Returns the motion multiplied by @p factor [-]. */
    GroundMotion scaled(double factor) const;

    /** Returns the same motion with @p n steps in each sampling interval. */
    GroundMotion refined(unsigned int n) const;

    /** Returns the motion of a station minus this motion. */
    GroundMotion relative(const MotionStation &station) const;

    /** Returns velocity and displacement, by exact integration of the linear acceleration. */
    MotionIntegrals integrated() const;
  };

  /** Standard acceleration of gravity, for accelerations in g [m/s^2]. */
  constexpr double standard_gravity = 9.80665;

  /** Returns a unit of acceleration (Motion/Unit) in m/s^2. Throws InputError for other text. */
  double unit_of_acceleration(const std::string &unit);

  /** Writes a CSV file with the header `t,a_x,a_y,a_z` [s, m/s^2], which make_motion() can read. Throws
   * WriteError if @p file cannot be written. */
  void write_motion(const GroundMotion &motion, const std::string &file);
} // namespace Voussoir

#endif
