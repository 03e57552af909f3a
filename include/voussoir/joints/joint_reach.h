// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_reach_h
#define voussoir_joint_reach_h

#include <voussoir/solid/solid_model.h>

#include <string>
#include <vector>

namespace Voussoir
{
  /** Monitor of joint movements that are too large for node-to-node contact. A pair acts as if its nodes
   * still faced each other. The error is of the order of the movement divided by the local element width.
   * From half a width on, a node faces the neighbour of its partner. */
  class JointReach
  {
  public:
    JointReach() = default;

    /** Computes the element width at each pair: the shortest edge of the joint faces there, divided by the
     * element degree [m]. */
    JointReach(const SolidModel &model, const std::vector<Pair> &pairs);

    /** Records the movement of pair number @p p. @p moved: opening (n) and slip (a, b) [m]. */
    void record(unsigned int p, const Pair &pair, const Vector3 &moved);

    /** Returns one warning for each joint with a movement above half the element width: number, opening or
     * slip, amount and position. */
    std::vector<std::string> warnings() const;

    const std::vector<double> &widths() const { return width; } ///< element width of each pair [m]

    template <class Archive> void serialize(Archive &archive, unsigned int) { archive &farthest; }

  private:
    enum
    {
      share,   ///< largest movement so far, divided by the width
      value,   ///< this opening or slip [m]
      local,   ///< element width there [m]
      is_slip, ///< 1: slip, 0: opening
      x,
      y,
      z,
      n_values
    };
    std::vector<double> width, farthest; ///< per pair; n_values per joint
  };
} // namespace Voussoir

#endif
