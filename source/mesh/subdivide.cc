// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/mesh/subdivide.h>

#include <algorithm>
#include <map>

namespace Voussoir
{
  namespace
  {
    /** Corner with its three neighbours along edges, counter-clockwise seen from inside the cell. */
    using Corner = std::array<unsigned int, 4>;

    const std::vector<Corner> hexahedron = {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7},
                                            {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}};
    const std::vector<Corner> wedge = {{0, 1, 2, 3}, {1, 2, 0, 4}, {2, 0, 1, 5},
                                       {3, 5, 4, 0}, {4, 3, 5, 1}, {5, 4, 3, 2}};

    const std::vector<std::vector<unsigned int>> hexahedron_faces = {
        {0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    const std::vector<std::vector<unsigned int>> wedge_faces = {
        {0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};

    /** Nodes at the midpoints of edges, faces and cells, by their corner nodes. */
    class Middles
    {
    public:
      explicit Middles(std::vector<std::array<double, 3>> &nodes) : nodes(nodes) {}

      unsigned int of(std::vector<unsigned int> around)
      {
        std::sort(around.begin(), around.end());
        const auto found = number.emplace(around, nodes.size());
        if (found.second)
        {
          std::array<double, 3> sum{};
          for (const unsigned int node : around)
            for (unsigned int d = 0; d < 3; ++d)
              sum[d] += nodes[node][d] / around.size();
          nodes.push_back(sum);
        }
        return found.first->second;
      }

    private:
      std::vector<std::array<double, 3>>               &nodes;
      std::map<std::vector<unsigned int>, unsigned int> number;
    };

    /** Returns the nodes of the face of a cell that has the corners @p a, @p b and @p c. */
    std::vector<unsigned int> face_with(const std::vector<unsigned int> &cell, const unsigned int a,
                                        const unsigned int b, const unsigned int c)
    {
      for (const auto &face : cell.size() == 6 ? wedge_faces : hexahedron_faces)
        if (std::count(face.begin(), face.end(), a) + std::count(face.begin(), face.end(), b) +
                std::count(face.begin(), face.end(), c) ==
            3)
        {
          std::vector<unsigned int> nodes;
          for (const unsigned int corner : face)
            nodes.push_back(cell[corner]);
          return nodes;
        }
      return {};
    }
  } // namespace

  std::vector<unsigned int> without_double_corners(const std::vector<unsigned int> &h)
  {
    // Faces at the ends of the collapsed edges become triangles. The collapsed edge of each face starts at
    // its corner e.
    const unsigned int ends[3][2][4] = {
        {{0, 1, 2, 3}, {4, 5, 6, 7}}, {{0, 4, 5, 1}, {3, 7, 6, 2}}, {{0, 3, 7, 4}, {1, 2, 6, 5}}};
    if (h.size() != 8) // a wedge already
      return h;
    for (const auto &end : ends)
      for (unsigned int e = 0; e < 4; ++e)
      {
        const unsigned int next = (e + 1) % 4;
        if (h[end[0][e]] != h[end[0][next]] || h[end[1][e]] != h[end[1][next]])
          continue;
        std::vector<unsigned int> result;
        for (const auto &face : end)
          for (unsigned int k = 1; k < 4; ++k)
            result.push_back(h[face[(e + k) % 4]]);
        return result;
      }
    return h;
  }

  void subdivide(const MixedMesh &mixed, HexMesh &mesh)
  {
    mesh.nodes = mixed.nodes;
    Middles middles(mesh.nodes);
    for (const MixedMesh::Cell &cell : mixed.cells)
    {
      const auto        &n = cell.nodes;
      const unsigned int centre = middles.of(n);
      for (const Corner &c : n.size() == 6 ? wedge : hexahedron)
      {
        const unsigned int ab = middles.of(face_with(n, c[0], c[1], c[2])),
                           bc = middles.of(face_with(n, c[0], c[2], c[3])),
                           ca = middles.of(face_with(n, c[0], c[3], c[1]));
        mesh.cells.push_back({{n[c[0]], middles.of({n[c[0]], n[c[1]]}), ab, middles.of({n[c[0]], n[c[2]]}),
                               middles.of({n[c[0]], n[c[3]]}), ca, centre, bc},
                              cell.volume,
                              cell.zone});
      }
    }
    for (const MixedMesh::Face &face : mixed.faces)
    {
      const auto        &n = face.nodes;
      const unsigned int centre = middles.of(n);
      for (std::size_t v = 0; v < n.size(); ++v)
        mesh.faces.push_back({{n[v], middles.of({n[v], n[(v + 1) % n.size()]}), centre,
                               middles.of({n[v], n[(v + n.size() - 1) % n.size()]})},
                              face.surface});
    }
  }
} // namespace Voussoir
