// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_mesh_warnings_h
#define voussoir_mesh_warnings_h

#include <voussoir/dam/scene.h>

namespace Voussoir
{
  /** Returns sentences about elements that are too distorted for their degree, or too long for the bond of
   * the joints.
   * @param opened mesh of the dam with open joints
   * @param zones of the concrete, all that the mesh has */
  std::vector<std::string> mesh_warnings(const HexMesh &opened, const Scene &scene,
                                         const std::vector<Zone> &zones);
} // namespace Voussoir

#endif
