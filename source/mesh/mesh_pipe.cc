// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/mesh/mesh_pipe.h>

namespace Voussoir
{
  void send(const HexMesh &mesh, PipeWriter &pipe)
  {
    pipe.put(mesh.nodes);
    pipe.put(mesh.cells);
    pipe.put(mesh.faces);
    pipe.put(mesh.names.size());
    for (const auto &entry : mesh.names)
    {
      pipe.put(entry.first.first);
      pipe.put(entry.first.second);
      pipe.put(entry.second);
    }
    pipe.put(mesh.zones.size());
    for (const std::string &zone : mesh.zones)
      pipe.put(zone);
  }

  void receive(PipeReader &pipe, HexMesh &mesh)
  {
    std::size_t n_names = 0;
    pipe.get(mesh.nodes);
    pipe.get(mesh.cells);
    pipe.get(mesh.faces);
    pipe.get(n_names);
    for (std::size_t i = 0; i < n_names; ++i)
    {
      int dimension = 0, id = 0;
      pipe.get(dimension);
      pipe.get(id);
      pipe.get(mesh.names[{dimension, id}]);
    }
    pipe.get(n_names);
    mesh.zones.clear();
    for (std::size_t i = 0; i < n_names; ++i)
    {
      std::string zone;
      pipe.get(zone);
      mesh.zones.push_back(zone);
    }
    for (const HexMesh::Cell &cell : mesh.cells)
      if (cell.zone >= mesh.zones.size())
        throw PipeReader::End();
    const auto check = [&](const auto &elements)
    {
      for (const auto &element : elements)
        for (const unsigned int node : element.nodes)
          if (node >= mesh.nodes.size()) // data of a corrupted process
            throw PipeReader::End();
    };
    check(mesh.cells);
    check(mesh.faces);
  }
} // namespace Voussoir
