// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_reach_h
#define voussoir_joint_reach_h

#include <voussoir/solid/solid_model.h>

#include <string>
#include <vector>

namespace Voussoir
{
  /** Whether joints open or slip so far that their pairs lie. Contact is node to node: a pair acts as if its
   * nodes still faced each other, which is an error of the order of the movement over the elements' width
   * there. From half a width on a node faces the neighbour of its partner. */
  class JointReach
  {
  public:
    JointReach() = default;

    /** Width of the faces at each pair: their shortest edge, over the degree for the nodes between [m]. */
    JointReach(const SolidModel &model, const std::vector<Pair> &pairs);

    /** @p moved: opening (n) and slip (a, b) of pair number @p p [m]. */
    void record(unsigned int p, const Pair &pair, const Vector3 &moved);

    /** A sentence for each joint that went too far: its number, what it did, by how much, where. */
    std::vector<std::string> warnings() const;

    const std::vector<double> &widths() const { return width; } ///< of the pairs [m]

    template <class Archive> void serialize(Archive &archive, unsigned int) { archive &farthest; }

  private:
    enum
    {
      share, ///< of the width: the largest so far
      value, ///< of the opening or slip that this was [m]
      local, ///< width there [m]
      is_slip,
      x,
      y,
      z,
      n_values
    };
    std::vector<double> width, farthest; ///< of each pair; n_values of each joint
  };
} // namespace Voussoir

#endif
