// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_mesh_joints_h
#define voussoir_mesh_joints_h

#include <voussoir/mesh/mesh.h>

#include <vector>

namespace Voussoir
{
  /** Joint of an opened mesh: an edge of the graph of monoliths and ground. Side 1 has the faces of monolith_1 and is
   * the surface with the id PhysicalId::joint_side_1 + number. Side 2 has the faces of monolith_2 and the id
   * PhysicalId::joint_side_2 + number. The ground has no faces. */
  struct Joint
  {
    int number;
    int monolith_1, monolith_2; ///< monolith_1 < monolith_2; monolith_1 is 0 for the ground

    bool        is_base() const { return monolith_1 == 0; }
    std::string kind() const { return is_base() ? "base" : "contraction"; }

    /** Returns "joint 3", or "base 2" for the base joint of monolith 2. */
    std::string name() const
    {
      return is_base() ? "base " + std::to_string(monolith_2) : "joint " + std::to_string(number);
    }
  };

  /** Returns the dam without the rock. */
  HexMesh monoliths_only(const HexMesh &mesh);

  /** Returns the mesh with doubled nodes at the joints. Monoliths share no nodes, except those of the rock.
   * The two sides of every joint are surfaces.
   *
   * Joint j lies between the monoliths j and j + 1. Contacts of other monoliths have the numbers from
   * n_monoliths() on, in the order of the monoliths. The base joints follow, one per monolith with faces in the surface
   * "base joint". Nodes of the rock are not doubled: where a joint meets the rock, its sides share the base node and are
   * tied there.
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

  /** Returns the joints of an opened mesh, in the order of their numbers. */
  std::vector<Joint> joints_of(const HexMesh &mesh);
} // namespace Voussoir

#endif
