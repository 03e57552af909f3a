// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_mesh_axes_h
#define voussoir_mesh_axes_h

#include <voussoir/mesh/mesh_source.h>

namespace Voussoir
{
  /** Checks the axes and the length unit of a mesh from a file, by the dam without the rock.
   *
   * Throws InputError, with the entry to change, in these cases:
   *  - The mean outward normal of the crest is more than 14 degrees from z (up).
   *  - The mean normal of the downstream face minus that of the upstream face is steeper than 63 degrees, or
   *    its horizontal part is more than 40 degrees from x (downstream).
   *  - The mean outward normal of the base is less than 63 degrees from z.
   *  - The height of the dam is above 400 m.
   *
   * Returns a warning for a height below 5 m, otherwise an empty string. A surface whose normals cancel, as those of a ring do, is not checked.
   *
   * @param mesh in metres, x downstream, y to the left bank, z up
   * @param parameters of the mesh. The check is skipped if the source is not "file".
   * @param source name of the file, for messages */
  std::string check_axes_and_units(const HexMesh &mesh, const MeshParameters &parameters,
                                   const std::string &source);
} // namespace Voussoir

#endif
