// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_base_motion_h
#define voussoir_base_motion_h

#include <voussoir/base/tensor3.h>
#include <voussoir/motion/ground_motion.h>

#include <array>
#include <vector>

namespace Voussoir
{
  /** Motion of the rock at the base nodes without the dam, relative to the ground motion: GroundMotion::stations.
   * The lowest node divides the banks: the left bank has the larger y. The displacement is interpolated linearly by
   * height between the stations of a bank. The lowest node has the ground motion, and so has a bank without a
   * station. Nodes above the highest station have its motion,
   * and so have all nodes of a bank with one station that is not above the lowest node. */
  class BaseMotion
  {
  public:
    /** @param motion ground motion with stations
     * @param places positions of the base nodes [m] */
    BaseMotion(const GroundMotion &motion, const std::vector<Vector3> &places);

    /** Throws InputError if two stations of a bank have the same height, or if a station is below the lowest base
     * node, or above the highest one by more than the height of the base. */
    static void check(const GroundMotion &motion, const std::vector<Vector3> &places);

    /** Returns the relative displacement at a time, three values per place [m]. */
    Unknowns displacement(double time) const { return at(time, &MotionIntegrals::displacement); }

    /** Returns the relative velocity at a time, three values per place [m/s]. */
    Unknowns velocity(double time) const { return at(time, &MotionIntegrals::velocity); }

  private:
    /** Two stations of a place with their shares; a share of 0: none. */
    struct Shares
    {
      std::array<unsigned int, 2> station{};
      std::array<double, 2>       share{};
    };

    Unknowns at(double time, std::vector<std::array<double, 3>> MotionIntegrals::*quantity) const;

    const double                 dt;       ///< [s]
    std::vector<MotionIntegrals> relative; ///< of the stations
    std::vector<Shares>          shares;   ///< of the places
  };
} // namespace Voussoir

#endif
