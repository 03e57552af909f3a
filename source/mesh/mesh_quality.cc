// SPDX-License-Identifier: GPL-3.0-or-later
// mesh_quality() of mesh.h

#include <voussoir/base/tensor3.h>
#include <voussoir/mesh/mesh.h>

#include <algorithm>

namespace Voussoir
{
  namespace
  {
    /** Three neighbours of each corner along edges, in right-handed order. */
    constexpr unsigned int neighbours[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
                                               {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
  } // namespace

  MeshQuality mesh_quality(const HexMesh &mesh, const bool of_rock)
  {
    MeshQuality quality{1e300, 0, 1e300, {}, 1, 0.};
    std::size_t n_cells = 0;
    for (const auto &cell : mesh.cells)
    {
      if (is_monolith(cell.volume) == of_rock)
        continue;
      double smallest = 1e300, largest = 0.;
      for (unsigned int v = 0; v < 8; ++v)
      {
        std::array<Vector3, 3> edge;
        double                 product = 1;
        for (unsigned int a = 0; a < 3; ++a)
        {
          for (unsigned int d = 0; d < 3; ++d)
            edge[a][d] = mesh.nodes[cell.nodes[neighbours[v][a]]][d] - mesh.nodes[cell.nodes[v]][d];
          const double length = norm(edge[a]);
          quality.shortest_edge = std::min(quality.shortest_edge, length);
          quality.longest_edge = std::max(quality.longest_edge, length);
          product *= length;
        }
        const Vector3 area = cross(edge[0], edge[1]);
        const double  volume = area[0] * edge[2][0] + area[1] * edge[2][1] + area[2] * edge[2][2];
        smallest = std::min(smallest, volume);
        largest = std::max(largest, volume);
        quality.smallest_scaled_jacobian = std::min(quality.smallest_scaled_jacobian, volume / product);
        for (unsigned int a = 0; a < 3; ++a)
        {
          const double height = volume / norm(cross(edge[a], edge[(a + 1) % 3]));
          if (height < quality.smallest_height)
          {
            quality.smallest_height = height;
            quality.smallest_height_at = centre(mesh, cell.nodes);
          }
        }
      }
      quality.mean_jacobian_ratio += smallest / largest;
      ++n_cells;
    }
    quality.mean_jacobian_ratio /= n_cells;
    return quality;
  }
} // namespace Voussoir
