// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh of the scene that is the argument, in numbers; its joints opened.

#include <voussoir/base/entries.h>
#include <voussoir/mesh/mesh_joints.h>
#include <voussoir/mesh/mesh_source.h>

#include <cstdio>

int main(int, char **argv)
{
  using namespace Voussoir;
  Entries        prm;
  MeshParameters parameters;
  parameters.add_parameters(prm);
  prm.parse_input(argv[1]);
  const HexMesh mesh = make_mesh(parameters, "."), opened = open_joints(mesh);
  std::printf("nodes %zu, opened %zu\ncells %zu\n", mesh.nodes.size(), opened.nodes.size(),
              mesh.cells.size());
  for (const auto &volume : volumes(mesh))
    std::printf("%s: %.12g thousand m^3\n", physical_name(3, volume.first).c_str(), volume.second / 1e3);
  for (const Joint &joint : joints_of(opened))
    std::printf("joint %d between monoliths %d and %d\n", joint.number, joint.block_1, joint.block_2);
  const auto        box = bounding_box(mesh);
  const MeshQuality quality = mesh_quality(mesh, false);
  std::printf("from (%.9f, %.9f, %.9f) to (%.9f, %.9f, %.9f) m\n", box.first[0], box.first[1], box.first[2],
              box.second[0], box.second[1], box.second[2]);
  std::printf("edges %.9f to %.9f m, smallest height %.9f m, smallest scaled Jacobian %.9f\n",
              quality.shortest_edge, quality.longest_edge, quality.smallest_height,
              quality.smallest_scaled_jacobian);
}
