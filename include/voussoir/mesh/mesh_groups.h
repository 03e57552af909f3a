// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_mesh_groups_h
#define voussoir_mesh_groups_h

#include <voussoir/mesh/mesh.h>

namespace Voussoir
{
  /** What is wrong with the name of a physical group that physical_id() does not know, and how to mend it:
   * the group with its @p tag, the nearest known name, and all known ones. */
  std::string unknown_group(int dimension, int tag, const std::string &name);

  /** The physical groups of a mesh, what the program takes them for, and how many hexahedra or faces each
   * has, one line each; successive monoliths and joints are drawn together. A group without a name is called
   * by its id. */
  std::string group_table(const HexMesh &mesh);

  /** How many outer faces of the dam are in no surface, and where the first is: "12 outer faces of the dam,
   * the first at (...) m, ..."; empty if there are none. They are free, and get no water. */
  std::string faces_without_group(const HexMesh &mesh);

  /** gmsh drops names that it does not understand, and ids would take their place: throws InputError where
   * $PhysicalNames of a gmsh file is not one line DIMENSION ID "NAME" for each group, or says one name twice.
   */
  void check_physical_names(const std::string &file);
} // namespace Voussoir

#endif
