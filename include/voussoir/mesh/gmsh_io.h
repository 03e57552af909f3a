// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_gmsh_io_h
#define voussoir_gmsh_io_h

#include <voussoir/mesh/mesh.h>

#include <string>

namespace Voussoir
{
  /** Reads hexahedra with physical volumes and quadrilaterals with physical surfaces from a gmsh file (MSH 2
   *  or 4), in the order of the file's tags. The name of a physical group decides what it is (physical_id(),
   * zone_of()); the ids of groups without names do. Coordinates are the file's: no axes or units are changed.
   * The mesh is normalized, not checked. Throws InputError: no such file, not a gmsh mesh, names that are not
   * known, volume elements that are not hexahedra, surface elements that are not
   * quadrilaterals, hexahedra in no or in two physical volumes, unknown ids. Of elements of second order only
   * the corners are taken.
   *  @p subdivided: with wedges and triangles, too, all of it divided by subdivide(). */
  HexMesh read_gmsh(const std::string &file, bool subdivided = false);

  /** Writes a gmsh file in MSH format @p version 4.1 or 2.2 with 16 digits; @p file ends in ".msh".
   *  Throws InputError if it cannot be written. */
  void write_gmsh(const HexMesh &mesh, const std::string &file, double version = 4.1);
} // namespace Voussoir

#endif
