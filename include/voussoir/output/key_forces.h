// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_key_forces_h
#define voussoir_key_forces_h

#include <voussoir/solid/structure.h>

namespace Voussoir
{
  struct JointParameters;

  /** Shear forces of the keys of each joint: sum over the pairs of the tangential force beyond the friction
   * limit of the face. This is a lower bound, because inclined flanks carry a part of the normal force and
   * reduce the friction of the face. */
  class KeyForces
  {
  public:
    KeyForces() = default; ///< no joint has keys

    /** Finds the joints with keys. */
    KeyForces(const Structure &structure, const JointParameters &parameters);

    /** Updates the largest forces. @p force: joint forces, three values per pair [N]. @p time: [s]. */
    void record(double time, const Unknowns &force);

    /** Largest shear force of the keys of a joint. */
    struct OfJoint
    {
      unsigned int joint;                                  ///< counted from 0
      double       area, force, time;                      ///< [m^2], largest force [N], its time [s]
      double       stress() const { return force / area; } ///< [Pa]
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
