// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_mesh_axes_h
#define voussoir_mesh_axes_h

#include <voussoir/mesh/mesh_source.h>

namespace Voussoir
{
  /** Throws InputError, with the entry that mends it, if the dam (without rock) does not look like one:
   *
   *  - its axes are turned or its faces exchanged: the mean outward normal of the crest is more than 63
   * degrees from z (up), the mean normal of the downstream face less that of the upstream face more than 63
   * degrees from x (downstream), or the base looks up. Faces that close (rings) are not judged.
   *  - its height is not between 5 m and 400 m: the length unit.
   *
   *  @p source: the file, for messages. */
  void check_axes_and_units(const HexMesh &mesh, const MeshParameters &parameters, const std::string &source);
} // namespace Voussoir

#endif
