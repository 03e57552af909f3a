#ifndef voussoir_motion_h
#define voussoir_motion_h

#include <array>
#include <cstddef>
#include <string>
#include <vector>

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
  };
} // namespace Voussoir

#endif
