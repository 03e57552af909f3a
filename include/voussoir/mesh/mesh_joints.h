// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_mesh_joints_h
#define voussoir_mesh_joints_h

#include <voussoir/mesh/mesh.h>

#include <vector>

namespace Voussoir
{
  /** Joint of an opened mesh: an edge of the graph of blocks and ground. A block is a monolith or one of its lifts.
   * Side 1 has the faces of block_1 and is the surface with the id PhysicalId::joint_side_1 + number. Side 2 has the
   * faces of block_2 and the id PhysicalId::joint_side_2 + number. The ground has no faces. */
  struct Joint
  {
    int number;
    int block_1,
        block_2; ///< volumes, of the lower monolith or the lower lift first; block_1 is 0 for the ground on a rigid
                 ///< base, and the footing of block_2 on rock

    int  monolith_1() const { return monolith_of(block_1); }
    int  monolith_2() const { return monolith_of(block_2); }
    bool is_base() const { return block_1 == 0 || is_footing(block_1); }
    bool is_lift() const { return !is_base() && monolith_1() == monolith_2(); }
    /** Returns true for lift joints and base joints on footings. */
    bool is_inside_monolith() const { return monolith_1() == monolith_2(); }
    bool is_contraction() const { return !is_base() && !is_lift(); }

    /** Returns "contraction", "lift" or "base". */
    std::string kind() const { return is_base() ? "base" : is_lift() ? "lift" : "contraction"; }

    /** Returns the number of the contraction joint between successive monoliths; a contraction joint between lifts has
     * that of its monoliths. Returns #number for others. */
    int contraction_number() const
    {
      return is_contraction() && monolith_2() == monolith_1() + 1 ? monolith_1() : number;
    }

    /** Returns the keys of the joint in input files, the most special first: name, number (not of lift joints),
     * kind. */
    std::vector<std::string> keys() const;

    /** Returns the standard name:
     * - "joint 3" between the lowest lifts of the monoliths 3 and 4, "joint 3.2" between their lifts 2, "joint 3.2-1"
     *   between lift 2 of monolith 3 and lift 1 of monolith 4;
     * - "lift 3.1" between the lifts 1 and 2 of monolith 3;
     * - "base 3" between the ground and monolith 3, "base 3.2" between the ground and its lift 2. */
    std::string name() const;
  };

  /** Returns the dam without the rock. */
  HexMesh monoliths_only(const HexMesh &mesh);

  /** Returns the mesh with doubled nodes at the joints. Blocks share no nodes, except those of the rock. A node has one
   * copy per block. The two sides of every joint are surfaces: two blocks that share faces have a joint.
   *
   * Joint j lies between the monoliths j and j + 1, or their lowest lifts. Contacts of other blocks have the numbers
   * from n_monoliths() on, in the order of the monoliths and lifts. The base joints follow, one per block with faces in
   * the surface "base joint". Nodes of the rock are not doubled: where a joint meets the rock, its sides share the base
   * node and are tied there.
   *
   * @param mesh conforming, with doubled nodes, or a mixture. It is closed first, so that all three give the
   * same mesh up to the numbers of the nodes. It must have passed check_mesh().
   *
   * Throws InputError like close_joints(), and if the number of a joint exceeds PhysicalId::max_joints. */
  HexMesh open_joints(const HexMesh &mesh);

  /** Returns the conforming mesh, for tied joints. Coincident nodes on the two sides of a joint are merged at
   * the position of the first one. The surfaces of the joints are removed.
   *
   * Two nodes coincide if their distance is at most 1e-4 of the shortest edge of the adjacent joint faces.
   * Throws InputError for a node or a face without a partner on the other side, with joint and position. */
  HexMesh close_joints(const HexMesh &mesh);

  using NumberPairs = std::vector<std::pair<unsigned int, unsigned int>>;

  /** Returns for each of @p n numbers the smallest number of its set. The numbers of a pair are in one set. */
  std::vector<unsigned int> smallest_of_sets(unsigned int n, const NumberPairs &pairs);

  /** Returns the joints of an opened mesh, in the order of their numbers. */
  std::vector<Joint> joints_of(const HexMesh &mesh);
} // namespace Voussoir

#endif
