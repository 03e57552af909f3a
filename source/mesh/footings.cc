// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/mesh/footings.h>

#include <voussoir/base/tensor3.h>
#include <voussoir/mesh/mesh_joints.h>

#include <algorithm>
#include <map>

namespace Voussoir
{
  namespace
  {
    /** Corners of a face of a base joint, counter-clockwise seen from the rock, and its cell. */
    struct BaseFace
    {
      std::array<unsigned int, 4> nodes;
      unsigned int                cell;
    };

    std::vector<BaseFace> base_faces(const HexMesh &mesh)
    {
      const FaceTable       table(mesh);
      std::vector<BaseFace> result;
      for (const HexMesh::Face &face : mesh.faces)
        if (face.surface == PhysicalId::base_joint)
        {
          const FaceTable::Entry &owner = *table.owners(face.nodes).first;
          BaseFace                at_base{{}, owner.cell};
          for (unsigned int v = 0; v < 4; ++v)
            at_base.nodes[v] = mesh.cells[owner.cell].nodes[hex_faces[owner.cell_face][v]];
          result.push_back(at_base);
        }
      return result;
    }

    /** Returns the nodes below those of the faces, at the distance @p thickness along the mean normal. */
    std::map<unsigned int, unsigned int> add_nodes(const std::vector<BaseFace> &faces, const double thickness,
                                                   HexMesh &mesh)
    {
      std::map<unsigned int, Vector3> normal; // not of unit length
      for (const BaseFace &face : faces)
      {
        const auto place = [&](const unsigned int v) -> const Vector3 & { return mesh.nodes[face.nodes[v]]; };
        const Vector3 of_face = cross(place(2) - place(0), place(3) - place(1));
        for (const unsigned int node : face.nodes)
          add(normal[node], of_face);
      }
      std::map<unsigned int, unsigned int> below;
      for (const auto &[node, n] : normal)
      {
        below[node] = mesh.nodes.size();
        Vector3 place = mesh.nodes[node];
        for (unsigned int c = 0; c < 3; ++c)
          place[c] += thickness / norm(n) * n[c];
        mesh.nodes.push_back(place);
      }
      return below;
    }

    /** Returns the thickness of the footings [m]. Much thinner ones are so light and stiff that round-off errors grow. */
    double thickness(const std::vector<BaseFace> &faces, const HexMesh &mesh)
    {
      double shortest = 1e300;
      for (const BaseFace &face : faces)
        for (unsigned int v = 0; v < 4; ++v)
          shortest = std::min(
              shortest, distance_between(mesh.nodes[face.nodes[v]], mesh.nodes[face.nodes[(v + 1) % 4]]));
      return .005 * shortest;
    }
  } // namespace

  HexMesh with_footings(const HexMesh &mesh)
  {
    HexMesh                     result = close_joints(mesh);
    const std::vector<BaseFace> faces = base_faces(result);
    const auto                  below = add_nodes(faces, thickness(faces, result), result);
    result.faces.erase(std::remove_if(result.faces.begin(), result.faces.end(),
                                      [](const HexMesh::Face &face)
                                      { return face.surface == PhysicalId::base_joint; }),
                       result.faces.end());
    for (const BaseFace &face : faces)
    {
      HexMesh::Cell cell = result.cells[face.cell];
      HexMesh::Face on_rock{{}, PhysicalId::base};
      cell.volume = footing_of(cell.volume);
      for (unsigned int v = 0; v < 4; ++v)
      {
        cell.nodes[v] = on_rock.nodes[v] = below.at(face.nodes[3 - v]);
        cell.nodes[4 + v] = face.nodes[3 - v];
      }
      result.cells.push_back(cell);
      result.faces.push_back(on_rock);
    }
    return open_joints(result);
  }
} // namespace Voussoir
