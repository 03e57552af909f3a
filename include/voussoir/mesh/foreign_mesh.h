// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_foreign_mesh_h
#define voussoir_foreign_mesh_h

#include <voussoir/mesh/mesh.h>

namespace Voussoir
{
  /** Returns true if the extension of @p file is .inp or .med: scripts/mesh_to_msh.py can read it. */
  bool is_foreign_mesh(const std::string &file);

  /** Reads a mesh file of another program. The script mesh_to_msh.py converts it to a gmsh file, which
   * read_gmsh() reads.
   * @param file path of the .inp or .med file
   * @param subdivided as in read_gmsh()
   *
   * Throws InputError with the message of the script, or if Python or its package meshio is missing. Throws
   * WriteError if no temporary directory can be created. */
  HexMesh read_foreign_mesh(const std::string &file, bool subdivided);
} // namespace Voussoir

#endif
