// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_ground_motion_h
#define voussoir_ground_motion_h

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace Voussoir
{
  /** Velocity and displacement of a motion at its samples, from rest: [m/s], [m]. */
  struct MotionIntegrals
  {
    std::vector<std::array<double, 3>> velocity, displacement;
  };

  /** Acceleration of the base in the axes of the scene: x downstream, y across the valley, z up. */
  struct GroundMotion
  {
    double                             dt = 0.01;    ///< sampling interval [s]
    std::vector<std::array<double, 3>> acceleration; ///< a_x, a_y, a_z [m/s^2] at t = k dt
    std::vector<std::string>           notes;        ///< what was done to records, for the user

    double                duration() const;            ///< time of the last sample [s]
    std::array<double, 3> sample(std::size_t k) const; ///< at t = k dt [m/s^2]; zero after the end
    std::array<double, 3> at(double t) const;          ///< linear interpolation; zero outside the record
    std::vector<double>   component(unsigned int direction) const; ///< 0, 1, 2 for x, y, z
    GroundMotion          scaled(double factor) const;
    GroundMotion          refined(unsigned int n) const; ///< with @p n steps in each sampling interval
    MotionIntegrals       integrated() const;            ///< exact for linear acceleration between samples
  };

  /** Standard gravity, for accelerations given in g [m/s^2]. */
  constexpr double standard_gravity = 9.80665;

  /** CSV with the header `t,a_x,a_y,a_z` [s, m/s^2], as make_motion() reads it. Throws WriteError. */
  void write_motion(const GroundMotion &motion, const std::string &file);
} // namespace Voussoir

#endif
