// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_foreign_mesh_h
#define voussoir_foreign_mesh_h

#include <voussoir/mesh/mesh.h>

namespace Voussoir
{
  /** Is it a file that the script mesh_to_msh.py reads (.inp, .med), by its ending? */
  bool is_foreign_mesh(const std::string &file);

  /** Reads the mesh of another program: scripts/mesh_to_msh.py makes a gmsh file of it, for read_gmsh().
   * Throws InputError with what the script says, or where Python or its package meshio is missing. */
  HexMesh read_foreign_mesh(const std::string &file, bool subdivided);
} // namespace Voussoir

#endif
