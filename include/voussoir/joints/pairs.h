// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_pairs_h
#define voussoir_pairs_h

#include <voussoir/solid/solid_model.h>

#include <functional>
#include <map>
#include <vector>

namespace Voussoir
{
  /** Pair by the index of its joint and the free node on side 1, or on side 2 if side 1 is the ground. */
  using PairsByNode = std::map<std::pair<unsigned int, unsigned int>, unsigned int>;
  PairsByNode pairs_by_node(const std::vector<Pair> &pairs);

  /** Returns the pairs of the joints 1 to @p n_joints, joint after joint. A pair consists of coincident nodes
   * of the two sides of a joint, or of the ground and a node of side 2 (base joints). The frame of the pair is
   * {n, a, b}: n from side 1 to side 2, b upwards in the joint, a = b x n. Pairs of two fixed nodes, or of nodes that
   * move together, are omitted.
   *
   * At an edge (normals of the faces differ by more than 20 degrees, as at meshed shear keys) the pair has
   * several planes. Its frame is that of the plane closest to the mean normal of the joint.
   *
   * Throws InputError for nodes without a coincident partner. */
  std::vector<Pair> find_pairs(const SolidModel &model, unsigned int n_joints);

  /** Makes coincident nodes on the two sides of joints move together, and joins their bodies.
   * @param model mesh and numbering, changed in place
   * @param n_joints number of joints
   * @param is_tied whether the joint with this index is tied; none: all joints are, and all bodies become one */
  void tie_joints(SolidModel &model, unsigned int n_joints,
                  const std::function<bool(unsigned int)> &is_tied = nullptr);

  /** Merges all bodies into one: coincident base nodes on the two sides of the joints 1 to @p n_joints move
   * together. */
  void tie_base_nodes(SolidModel &model, unsigned int n_joints);

  /** Returns the clusters of pairs that are connected by common free nodes, as where joints cross. A cluster has at
   * least two pairs, in ascending order. */
  std::vector<std::vector<unsigned int>> clusters_of(const std::vector<Pair> &pairs);

  /** Returns Structure::clusters. If there are any, the lower ends of contraction joints on the rigid ground are added:
   * the base pairs of the two blocks at the same place, and the nearest pair between the blocks. */
  std::vector<std::vector<unsigned int>> clusters_with_feet(const Structure &structure);
} // namespace Voussoir

#endif
