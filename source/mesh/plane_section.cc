// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/tensor3.h>
#include <voussoir/mesh/plane_section.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  double cosine_to_y(const HexMesh &mesh, const unsigned int cell_number, const unsigned int face)
  {
    const auto corner = [&](const unsigned int k)
    { return mesh.nodes[mesh.cells[cell_number].nodes[hex_faces[face][k]]]; };
    const Vector3 normal = cross(corner(2) - corner(0), corner(3) - corner(1));
    return std::abs(normal[1]) / norm(normal);
  }

  std::array<unsigned int, 8> across_y(const std::array<Vector3, 8> &x)
  {
    std::array<unsigned int, 8> result{};
    for (unsigned int i = 0; i < 8; ++i)
    {
      const auto distance = [&](const unsigned int k)
      { return k == i ? INFINITY : std::hypot(x[k][0] - x[i][0], x[k][2] - x[i][2]); };
      for (unsigned int k = 1; k < 8; ++k)
        if (distance(k) < distance(result[i]))
          result[i] = k;
    }
    return result;
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
    for (const HexMesh::Face &face : opened.faces)
      if (const FaceTable::Entry &entry = *table.owners(face.nodes).first;
          face.surface == PhysicalId::artificial && cosine_to_y(opened, entry.cell, entry.cell_face) > .5)
        throw InputError(
            "mesh " + source +
            ": with \"Mesh/Plane strain\", the rock has artificial boundaries "
            "upstream, downstream and below only, because the planes y = constant are planes of symmetry. "
            "Remove the face at " +
            place(centre(opened, face.nodes)) + " from the surface \"artificial boundary\".");
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
