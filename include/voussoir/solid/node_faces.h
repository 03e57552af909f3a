// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_node_faces_h
#define voussoir_node_faces_h

#include <voussoir/base/tensor3.h>

#include <vector>

namespace Voussoir
{
  class SolidModel;

  /** Boundary face at one of its nodes. */
  struct NodeFace
  {
    unsigned int node;    ///< node of the model
    int          surface; ///< boundary id
    Vector3      normal;  ///< outward unit normal
  };

  /** Returns the boundary faces at all boundary nodes that are not on the surface "base", sorted by node.
   * Element faces of one surface count as one face if their normals at a node differ by less than 30 degrees.
   * Its normal is the area-weighted mean. In plane strain the sides of the slice do not count: their stress is
   * unknown. */
  std::vector<NodeFace> faces_at_nodes(const SolidModel &model);

  /** Returns the faces of the surface "base" at its nodes, in the same form. */
  std::vector<NodeFace> faces_of_base(const SolidModel &model);
} // namespace Voussoir

#endif
