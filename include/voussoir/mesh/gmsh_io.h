// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_gmsh_io_h
#define voussoir_gmsh_io_h

#include <voussoir/mesh/mesh.h>

#include <string>

namespace Voussoir
{
  /** Reads the hexahedra in physical volumes and the quadrilaterals in physical surfaces of a gmsh file (MSH
   * 2 or 4), in the order of the tags in the file.
   *
   * The name of a physical group determines its meaning (physical_id(), zone_of()). A group without a name
   * has the meaning of its id. The coordinates are those of the file: axes and units are unchanged. Elements
   * of second order are read by their corners. The mesh is normalized with normalize(), but not checked.
   *
   * @param file path of the mesh
   * @param subdivided allows wedges and triangles, and divides all cells and faces with subdivide()
   *
   * Throws InputError if the file does not exist or is not a gmsh mesh, for unknown names and ids, for
   * elements of other types, and for hexahedra in no physical volume or in two. */
  HexMesh read_gmsh(const std::string &file, bool subdivided = false);

  /** Writes a gmsh file in MSH format @p version 4.1 or 2.2, with 16 digits.
   *
   * Throws InputError if @p file does not end in ".msh" or @p version is another number. Throws WriteError if
   * the file cannot be written. */
  void write_gmsh(const HexMesh &mesh, const std::string &file, double version = 4.1);
} // namespace Voussoir

#endif
