// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/tensor3.h>
#include <voussoir/mesh/boundary_lines.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    constexpr double tolerance = 1e-5; ///< relative to the spacing

    constexpr CutFace cut_faces[5] = {CutFace::upstream, CutFace::downstream, CutFace::right, CutFace::left,
                                      CutFace::bottom};

    /** Row of hex_faces opposite to each row. */
    constexpr unsigned int opposite_face[6] = {1, 0, 4, 5, 2, 3};

    /** Returns true if an edge of the hexahedron connects the corners @p a and @p b. */
    bool are_joined(const unsigned int a, const unsigned int b)
    {
      return a % 4 == b % 4 || (a / 4 == b / 4 && (a + 1) % 4 == b % 4) ||
             (a / 4 == b / 4 && (b + 1) % 4 == a % 4);
    }

    class Search
    {
    public:
      Search(const HexMesh &mesh, const unsigned int n_layers, const std::string &source)
          : mesh(mesh), n_layers(n_layers), source(source), table(mesh), box(bounding_box(mesh)),
            line_of(mesh.nodes.size(), none)
      {
      }

      std::vector<GridLine> run()
      {
        std::vector<std::pair<CutFace, const FaceTable::Entry *>> faces;
        for (const auto &face : mesh.faces)
          if (face.surface == PhysicalId::artificial)
          {
            const auto *entry = table.owners(face.nodes).first;
            faces.emplace_back(cut_face(*entry), entry);
          }
        // A node keeps its first line: the order of cut_faces decides.
        std::stable_sort(faces.begin(), faces.end(),
                         [](const auto &a, const auto &b) { return a.first < b.first; });
        for (const auto &face : faces)
          follow(face.first, *face.second);
        for (const GridLine &line : lines)
          check(line);
        std::sort(lines.begin(), lines.end(),
                  [](const auto &a, const auto &b) { return a.nodes[0] < b.nodes[0]; });
        return std::move(lines);
      }

    private:
      static constexpr unsigned int none = -1;

      [[noreturn]] void fail(const std::string &text) const
      {
        throw InputError("mesh " + source + ": artificial boundary: " + text);
      }

      std::string called(const int volume) const
      {
        const auto name = mesh.names.find({3, volume});
        return "'" + (name != mesh.names.end() ? name->second : physical_name(3, volume)) + "'";
      }

      /** Returns the plane in which a face lies. */
      CutFace cut_face(const FaceTable::Entry &entry) const
      {
        for (const CutFace face : cut_faces)
        {
          const unsigned int axis = normal_axis(face);
          const bool         is_upper = face == CutFace::downstream || face == CutFace::left;
          const double       plane = (is_upper ? box.second : box.first)[axis];
          if (std::all_of(entry.key.begin(), entry.key.end(),
                          [&](const unsigned int node)
                          { return std::abs(mesh.nodes[node][axis] - plane) <= tolerance * depth(entry); }))
            return face;
        }
        fail("the face at " + place(centre(mesh, entry.key)) +
             " lies in none of the planes of smallest x, largest x, smallest y, largest y and smallest z. "
             "Cut the rock by these five planes, and put the ground into the surface 'free surface'.");
      }

      /** Returns the length of the shortest edge from the face into its cell [m]. */
      double depth(const FaceTable::Entry &entry) const
      {
        double     shortest = 1e300;
        const auto next = across(entry.cell, entry.cell_face);
        for (unsigned int v = 0; v < 4; ++v)
        {
          const Vector3 &a = mesh.nodes[mesh.cells[entry.cell].nodes[hex_faces[entry.cell_face][v]]];
          const Vector3 &b = mesh.nodes[next[v]];
          shortest = std::min(shortest, distance_between(a, b));
        }
        return shortest;
      }

      /** Returns the nodes opposite to those of a face of a cell, in the order of hex_faces[face]. */
      std::array<unsigned int, 4> across(const unsigned int cell, const unsigned int face) const
      {
        std::array<unsigned int, 4> nodes{};
        for (unsigned int v = 0; v < 4; ++v)
          for (const unsigned int corner : hex_faces[opposite_face[face]])
            if (are_joined(hex_faces[face][v], corner))
              nodes[v] = mesh.cells[cell].nodes[corner];
        return nodes;
      }

      /** Follows the grid from a face through n_layers elements. Adds the lines of its nodes
       * without a line. */
      void follow(const CutFace face, const FaceTable::Entry &start)
      {
        const int                                volume = mesh.cells[start.cell].volume;
        std::array<std::vector<unsigned int>, 4> nodes;
        for (unsigned int v = 0; v < 4; ++v)
          nodes[v] = {mesh.cells[start.cell].nodes[hex_faces[start.cell_face][v]]};
        const FaceTable::Entry *entry = &start;
        for (unsigned int layer = 1;; ++layer)
        {
          const auto &cell = mesh.cells[entry->cell];
          if (cell.volume != volume)
            fail("behind the face at " + place(centre(mesh, start.key)) + " (" + name_of(face) +
                 "), the material changes from " + called(volume) + " to " + called(cell.volume) +
                 " in layer " + std::to_string(layer) + " of " + std::to_string(n_layers) +
                 ". Use one material in the layers of equal elements.");
          const auto next = across(entry->cell, entry->cell_face);
          for (unsigned int v = 0; v < 4; ++v)
            for (unsigned int w = 0; w < 4; ++w)
              if (cell.nodes[hex_faces[entry->cell_face][w]] == nodes[v].back())
              {
                nodes[v].push_back(next[w]);
                break;
              }
          if (layer == n_layers)
            break;
          const auto owners = table.owners(next);
          if (owners.second == nullptr)
            fail("behind the face at " + place(centre(mesh, start.key)) + " (" + name_of(face) +
                 ") there are only " + std::to_string(layer) + " layers of elements; " +
                 std::to_string(n_layers) +
                 " are needed. Refine the rock normal to this face, or move the boundary outward.");
          entry = owners.first->cell == entry->cell ? owners.second : owners.first;
        }
        for (auto &line : nodes)
        {
          unsigned int &known = line_of[line[0]];
          if (known == none)
          {
            known = lines.size();
            const Vector3 &a = mesh.nodes[line[0]], &b = mesh.nodes[line[1]];
            lines.push_back({face, std::abs(b[normal_axis(face)] - a[normal_axis(face)]), volume, line});
          }
          else if (lines[known].face == face && lines[known].nodes != line)
            fail("the grid lines from the node at " + place(mesh.nodes[line[0]]) + " (" + name_of(face) +
                 ") separate within " + std::to_string(n_layers) +
                 " elements. Mesh the rock along the boundary in layers (gmsh: Extrude or Transfinite).");
          else if (lines[known].face == face && lines[known].volume != volume)
            lines[known].volume = std::min(lines[known].volume, volume); // between two materials
        }
      }

      void check(const GridLine &line) const
      {
        const unsigned int axis = normal_axis(line.face);
        const Vector3     &start = mesh.nodes[line.nodes[0]];
        const double       step = mesh.nodes[line.nodes[1]][axis] - start[axis];
        for (unsigned int k = 1; k < line.nodes.size(); ++k)
        {
          const Vector3     &here = mesh.nodes[line.nodes[k]];
          std::ostringstream text;
          text << "the grid line from the node at " << place(start) << " (" << name_of(line.face) << ") ";
          for (unsigned int d = 0; d < 3; ++d)
            if (d != axis && !(std::abs(here[d] - start[d]) <= tolerance * line.spacing))
            {
              text << "is not straight and normal to this face: its node " << k << " of "
                   << line.nodes.size() - 1 << ", at " << place(here) << ", deviates by "
                   << here[d] - start[d] << " m in "
                   << "xyz"[d] << ". Make the outer " << line.nodes.size() - 1
                   << " layers of the rock prismatic: extrude the mesh of this face along its normal.";
              fail(text.str());
            }
          const double spacing = std::abs(here[axis] - mesh.nodes[line.nodes[k - 1]][axis]);
          if (!(std::abs(here[axis] - start[axis] - k * step) <= tolerance * line.spacing))
          {
            text << "has unequal spacing: " << line.spacing << " m at the boundary, but " << spacing
                 << " m before " << place(here) << ". Make the outer " << line.nodes.size() - 1
                 << " layers of elements equally thick.";
            fail(text.str());
          }
        }
      }

      const HexMesh                    &mesh;
      const unsigned int                n_layers;
      const std::string                &source;
      const FaceTable                   table;
      const std::pair<Vector3, Vector3> box;
      std::vector<unsigned int>         line_of; // index into lines, by boundary node
      std::vector<GridLine>             lines;
    };
  } // namespace

  std::string name_of(const CutFace face)
  {
    switch (face)
    {
    case CutFace::upstream:
      return "upstream";
    case CutFace::downstream:
      return "downstream";
    case CutFace::right:
      return "right bank";
    case CutFace::left:
      return "left bank";
    default:
      return "bottom";
    }
  }

  unsigned int normal_axis(const CutFace face)
  {
    return face == CutFace::bottom ? 2 : (face == CutFace::right || face == CutFace::left ? 1 : 0);
  }

  std::vector<GridLine> boundary_lines(const HexMesh &mesh, const unsigned int n_layers,
                                       const std::string &source)
  {
    return Search(mesh, n_layers, source).run();
  }
} // namespace Voussoir
