// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_mesh_pipe_h
#define voussoir_mesh_pipe_h

#include <voussoir/base/guarded.h>
#include <voussoir/mesh/mesh.h>

namespace Voussoir
{
  /** A mesh through a pipe. */
  void send(const HexMesh &mesh, PipeWriter &pipe);

  /** What send() sent. Throws PipeReader::End if an element has a node that is not there. */
  void receive(PipeReader &pipe, HexMesh &mesh);
} // namespace Voussoir

#endif
