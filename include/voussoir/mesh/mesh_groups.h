// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_mesh_groups_h
#define voussoir_mesh_groups_h

#include <voussoir/mesh/mesh.h>

namespace Voussoir
{
  /** Returns a message about a physical group with an unknown name. The message has the group with its
   * @p tag, the nearest known name, and all known names.
   * @param dimension 3: volume, 2: surface
   * @param tag id of the group in the file
   * @param name unknown name of the group */
  std::string unknown_group(int dimension, int tag, const std::string &name);

  /** Returns a table of the physical groups of a mesh. Each line has the group, its meaning, and the number
   * of its hexahedra or faces. Successive monoliths or joints have a common line. A group without a name is
   * listed by its id. */
  std::string group_table(const HexMesh &mesh);

  /** Returns a warning about outer faces of the dam that are in no surface, with their number and the
   * position of the first. Such faces are free and have no water pressure. The string is empty if there are
   * no such faces. @p plane_strain: true if the two faces across y need no surface. */
  std::string faces_without_group(const HexMesh &mesh, bool plane_strain = false);

  /** Checks the section $PhysicalNames of a gmsh file. Gmsh ignores names that it cannot parse, so that the
   * ids would be used instead.
   *
   * Throws InputError if a line is not DIMENSION ID "NAME", if the number of lines is wrong, or if two groups
   * have the same name. Names that begin with "rock" may be repeated. */
  void check_physical_names(const std::string &file);
} // namespace Voussoir

#endif
