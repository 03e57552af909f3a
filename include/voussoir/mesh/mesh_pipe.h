// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_mesh_pipe_h
#define voussoir_mesh_pipe_h

#include <voussoir/base/guarded.h>
#include <voussoir/mesh/mesh.h>

namespace Voussoir
{
  /** Writes a mesh to a pipe. */
  void send(const HexMesh &mesh, PipeWriter &pipe);

  /** Reads a mesh that send() wrote. Throws PipeReader::End if a node or a zone of an element is missing from
   * the data. */
  void receive(PipeReader &pipe, HexMesh &mesh);
} // namespace Voussoir

#endif
