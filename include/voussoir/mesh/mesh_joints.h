// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_mesh_joints_h
#define voussoir_mesh_joints_h

#include <voussoir/mesh/mesh.h>

#include <vector>

namespace Voussoir
{
  /** A contraction joint. Its sides are the surfaces PhysicalId::joint_side_1 + number (faces of monolith_1)
   *  and PhysicalId::joint_side_2 + number (faces of monolith_2) of an opened mesh. */
  struct Joint
  {
    int number;
    int monolith_1, monolith_2; ///< monolith_1 < monolith_2
  };

  /** The dam without the rock. */
  HexMesh monoliths_only(const HexMesh &mesh);

  /** The mesh in which no two monoliths share a node, and the two sides of every joint are surfaces.
   *
   *  Joint j lies between monoliths j and j+1; contacts of other monoliths get the numbers from
   *  n_monoliths() on, in the order of the monoliths. The nodes of the rock are not doubled: the foot of a
   *  joint on rock stays one node, tied. The input may be conforming, doubled or a mixture: it is closed
   *  first, so that all three give the same result but for the numbers of the nodes. It must have passed
   *  check_mesh().
   *  Throws InputError as close_joints(), and for more than PhysicalId::max_joints joints. */
  HexMesh open_joints(const HexMesh &mesh);

  /** The conforming mesh, for tied joints: coincident nodes of the two sides of each joint become one (at the
   *  place of the first one), and the joints' surfaces are dropped.
   *
   *  Nodes coincide if they are closer than 1e-4 of the shortest edge of the joint's faces around them.
   *  Throws InputError for a node without partner (joint, coordinates, distance to the nearest node of the
   *  other side) and for a face without partner. */
  HexMesh close_joints(const HexMesh &mesh);

  /** The joints of an opened mesh, by number. */
  std::vector<Joint> joints_of(const HexMesh &mesh);
} // namespace Voussoir

#endif
