// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_footings_h
#define voussoir_footings_h

#include <voussoir/mesh/mesh.h>

namespace Voussoir
{
  /** Returns the opened mesh of a dam with base joints on rock. Below each face of the surface "base joint" lies a thin
   * cell of concrete, the footing, whose lower face is bonded to the rock. The base joint lies between footing and
   * dam. The nodes of the dam keep their positions, and those of the rock coincide with the lower nodes of the footings
   * but for their thickness, 0.5 % of the shortest edge of the base faces. Their mass and flexibility are negligible.
   *
   * Each block has a footing of its own, the volume footing_of() with the zone of the block. Footings have no joints
   * between each other.
   *
   * @param mesh dam without rock, see open_joints() */
  HexMesh with_footings(const HexMesh &mesh);
} // namespace Voussoir

#endif
