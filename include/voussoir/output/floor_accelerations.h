// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_floor_accelerations_h
#define voussoir_floor_accelerations_h

#include <voussoir/output/recorders.h>

#include <array>
#include <string>
#include <vector>

namespace Voussoir
{
  class Json;

  /** Evaluation of the absolute accelerations in history.csv: largest values, amplification of the ground
   * motion, and floor response spectra. The accelerations are means over the time steps, see
   * mean_acceleration(); those of the ground are means over the same steps. */
  class FloorAccelerations
  {
  public:
    /** Reads the columns "time", "base_acceleration_x,y,z" and, of each point, "NAME_acceleration_x,y,z".
     * @param history table of history.csv
     * @param points names of the points; the first one is the crest */
    FloorAccelerations(const Table &history, const std::vector<std::string> &points);

    /** Returns the table of floor_spectra.csv: pseudo-acceleration w^2 max |u| [m/s^2] of linear oscillators
     * under the accelerations of the points and of the ground, over the period [s].
     * @param dt time step [s]
     * @param damping damping ratio [-] */
    Table spectra(double dt, double damping) const;

    /** Returns "accelerations" of summary.json: for each point and the ground the largest absolute value of
     * each component [m/s^2] with its time [s]; for each point also the amplification, the ratio to the
     * largest value of the ground [-]. It is null if the ground does not move in this direction. */
    Json json() const;

    /** Returns the largest accelerations of the crest and their amplifications, for the log. */
    std::string in_words() const;

  private:
    using Components = std::array<std::vector<double>, 3>; // x, y, z; one value per time [m/s^2]

    struct Point
    {
      std::string name;
      Components  acceleration;
    };

    std::vector<double> time; ///< [s]
    std::vector<Point>  points;
    Components          ground;
  };
} // namespace Voussoir

#endif
