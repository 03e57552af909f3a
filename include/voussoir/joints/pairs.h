// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_pairs_h
#define voussoir_pairs_h

#include <voussoir/solid/solid_model.h>

namespace Voussoir
{
  /** The pairs of all joints 1..n_joints, in joint order: nodes of surfaces 100 + j and 200 + j that
   * coincide, with frame {n, a, b}: n from side 1 to side 2, b upwards in the joint, a = b x n. Throws
   * InputError for nodes that do not match. Pairs of two fixed nodes, and of nodes that
   * move as one, are left out.
   *
   *  Where faces meet at an edge (their normals differ by more than 20 degrees, as at meshed shear keys) the
   *  pair has several planes, and the frame of the one that is nearest to the joint's mean normal. */
  std::vector<Pair> find_pairs(const SolidModel &model, unsigned int n_joints);

  /** Make one body of all: coincident nodes on the two sides of joints 1..n_joints move as one, or only those
   * on the base, when @p feet_only. */
  void tie_joints(SolidModel &model, unsigned int n_joints, bool feet_only = false);
} // namespace Voussoir

#endif
