// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/mesh/plane_section.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  double cosine_to_y(const HexMesh &mesh, const unsigned int cell_number, const unsigned int face)
  {
    const HexMesh::Cell  &cell = mesh.cells[cell_number];
    std::array<double, 3> diagonal[2];
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int d = 0; d < 3; ++d)
        diagonal[k][d] =
            mesh.nodes[cell.nodes[hex_faces[face][2 + k]]][d] - mesh.nodes[cell.nodes[hex_faces[face][k]]][d];
    const auto &[a, b] = diagonal;
    const double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
    return std::abs(y) / std::hypot(x, y, z);
  }

  void check_plane_section(const HexMesh &opened, const std::string &source)
  {
    constexpr double tolerance = 1e-6; // of the size of the dam, and of cosines
    const auto [low, high] = bounding_box(opened);
    const double size = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    const auto   in_plane = [&](const FaceTable::Entry &face, const double y)
    {
      return std::all_of(face.key.begin(), face.key.end(),
                         [&, y](const unsigned int n)
                         { return std::abs(opened.nodes[n][1] - y) < tolerance * size; });
    };
    const FaceTable table(opened);
    for (const FaceTable::Entry &face : table.entries())
      if (table.owners(face.key).second == nullptr && !in_plane(face, low[1]) && !in_plane(face, high[1]) &&
          cosine_to_y(opened, face.cell, face.cell_face) > tolerance)
        throw InputError(
            "mesh " + source + ": \"Mesh/Plane strain\" requires the same section at each y. The face at " +
            place(centre(opened, face.key)) +
            " is neither parallel to y nor in one of the two planes that bound the dam along y. Use a "
            "slice of the dam between two planes y = constant, without joints across y, or set "
            "\"Mesh/Plane strain\" to false.");
  }
} // namespace Voussoir
