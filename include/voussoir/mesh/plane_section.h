// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_plane_section_h
#define voussoir_plane_section_h

#include <voussoir/base/tensor3.h>
#include <voussoir/mesh/mesh.h>

#include <array>
#include <string>

namespace Voussoir
{
  /** Returns the cosine of the angle between y and the normal of a face, 0 to 1.
   * @param cell index of the cell
   * @param face row of hex_faces */
  double cosine_to_y(const HexMesh &mesh, unsigned int cell, unsigned int face);

  /** Returns for each corner @p x of a cell that is a prism along y the one at its x and z [m]. */
  std::array<unsigned int, 8> across_y(const std::array<Vector3, 8> &x);

  /** Checks that a dam is a prism along y: each outer face and each side of a joint is parallel to y, or lies in one
   * of the planes at the smallest and the largest y. Throws InputError for another face.
   * @param opened monoliths with open joints, see open_joints() [m]
   * @param source name of the mesh for messages */
  void check_plane_section(const HexMesh &opened, const std::string &source);
} // namespace Voussoir

#endif
