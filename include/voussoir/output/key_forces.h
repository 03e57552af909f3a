// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_key_forces_h
#define voussoir_key_forces_h

#include <voussoir/solid/structure.h>

namespace Voussoir
{
  struct JointParameters;

  /** The shear forces that the flanks of keys carry, joint by joint: of the tangential force of each pair
   * what is more than the friction of its face can be, added up over the joint. It is at least that: where
   * flanks that lean carry a part of the normal force, the face has less friction. */
  class KeyForces
  {
  public:
    KeyForces() = default; ///< no joint has keys

    KeyForces(const Structure &structure, const JointParameters &parameters);

    void record(double time, const Unknowns &force); ///< 3 per pair [N]

    struct OfJoint
    {
      unsigned int joint;                                  ///< counted from 0
      double       area, force, time;                      ///< [m^2]; the largest force [N], when [s]
      double       stress() const { return force / area; } ///< [Pa]
    };
    std::vector<OfJoint> joints;        ///< with keys
    const OfJoint       &worst() const; ///< of all, by the stress; there must be one

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
