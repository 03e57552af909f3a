// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_node_faces_h
#define voussoir_node_faces_h

#include <voussoir/base/tensor3.h>

#include <vector>

namespace Voussoir
{
  class SolidModel;

  /** A face of the boundary at one of its nodes. */
  struct NodeFace
  {
    unsigned int node;    ///< of the model
    int          surface; ///< boundary id
    Vector3      normal;  ///< outward, of length 1
  };

  /** The faces at all nodes of the boundary but those of the surface "base", ascending in the nodes. Element
   * faces of one surface whose normals are within 30 degrees at a node count as one, with their mean normal
   * by area. */
  std::vector<NodeFace> faces_at_nodes(const SolidModel &model);

  /** The same of the surface "base", at its nodes. */
  std::vector<NodeFace> faces_of_base(const SolidModel &model);
} // namespace Voussoir

#endif
