// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_key_forces_h
#define voussoir_key_forces_h

#include <voussoir/solid/structure.h>

#include <string>

namespace Voussoir
{
  /** Shear forces of the keys of each joint: sum over the pairs of the tangential force beyond the friction
   * limit of the face. This is a lower bound, because inclined flanks carry a part of the normal force and
   * reduce the friction of the face. */
  class KeyForces
  {
  public:
    KeyForces() = default; ///< no joint has keys

    /** Finds the joints with keys.
     * @param structure pairs of the joints
     * @param models names of the laws of the joints
     * @param friction coefficient of friction of the faces [-] */
    KeyForces(const Structure &structure, const std::vector<std::string> &models, double friction);

    /** Updates the largest forces.
     * @param time present time [s]
     * @param force joint forces, three values per pair [N] */
    void record(double time, const Unknowns &force);

    /** Largest shear force of the keys of a joint. */
    struct OfJoint
    {
      unsigned int joint; ///< index of the joint, counted from 0
      double       area;  ///< area of the joint [m^2]
      double       force; ///< largest shear force of the keys [N]
      double       time;  ///< time of the largest force [s]

      /** Returns force divided by area [Pa]. */
      double stress() const { return force / area; }
    };
    std::vector<OfJoint> joints; ///< joints with keys

    /** Returns the joint with the largest stress. At least one joint must have keys. */
    const OfJoint &worst() const;

    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      for (OfJoint &one : joints) // as many as there are
        archive &one.force &one.time;
    }

  private:
    std::vector<Pair> pairs;
    double            friction = 0.;
  };
} // namespace Voussoir

#endif
