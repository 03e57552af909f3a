// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_mesh_warnings_h
#define voussoir_mesh_warnings_h

#include <voussoir/dam/scene.h>

namespace Voussoir
{
  /** Returns warnings about blocks in several parts, and elements that are too distorted for their degree, or too long
   * for cohesive joints.
   * @param opened mesh of the dam with open joints
   * @param scene input file
   * @param zones all zones of the concrete in the mesh */
  std::vector<std::string> mesh_warnings(const HexMesh &opened, const Scene &scene,
                                         const std::vector<Zone> &zones);
} // namespace Voussoir

#endif
