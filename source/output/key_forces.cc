// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/contact/law_table.h>
#include <voussoir/output/key_forces.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  KeyForces::KeyForces(const Structure &structure, const std::vector<std::string> &models,
                       const double friction)
      : pairs(structure.pairs), friction(friction)
  {
    for (unsigned int j = 0; j < structure.n_joints; ++j)
    {
      double area = 0.;
      for (const Pair &pair : pairs)
        area += pair.joint == j ? pair.area : 0.;
      if (area > 0. && joint_law_reads(models[j], "Joints/Keys/Height"))
        joints.push_back({j, area, 0., 0.});
    }
  }

  void KeyForces::record(const double time, const Unknowns &force)
  {
    for (OfJoint &one : joints)
    {
      double sum = 0.;
      for (std::size_t p = 0; p < pairs.size(); ++p)
        if (pairs[p].joint == one.joint)
          sum += std::max(0., std::hypot(force[3 * p + 1], force[3 * p + 2]) -
                                  friction * std::max(0., force[3 * p]));
      if (sum > one.force)
        one.force = sum, one.time = time;
    }
  }

  const KeyForces::OfJoint &KeyForces::worst() const
  {
    return *std::max_element(joints.begin(), joints.end(),
                             [](const OfJoint &a, const OfJoint &b) { return a.stress() < b.stress(); });
  }
} // namespace Voussoir
