// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_grid_h
#define voussoir_rock_grid_h

#include <voussoir/base/tensor3.h>
#include <voussoir/mesh/mesh.h>
#include <voussoir/rock/rock_parameters.h>

#include <cmath>

namespace Voussoir
{
  constexpr unsigned int no_node = static_cast<unsigned int>(-1);

  /** Corners of the unit cell in the order of a cell's nodes, and the three corners next to each. */
  constexpr int          unit_cube[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                            {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  constexpr unsigned int corners_beside[8][3] = {{1, 3, 4}, {0, 2, 5}, {3, 1, 6}, {2, 0, 7},
                                                 {5, 7, 0}, {4, 6, 1}, {7, 5, 2}, {6, 4, 3}};
  constexpr unsigned int opposite_corner[8] = {6, 7, 4, 5, 2, 3, 0, 1};

  /** What is needed of the mesh's topology. */
  struct RockGrid
  {
    const HexMesh                         &mesh;
    std::vector<bool>                      in_region;     ///< of each cell
    std::vector<std::vector<unsigned int>> cells_of_node; ///< of the region

    RockGrid(const HexMesh &mesh, const RockParameters &parameters);

    /** Of @p node in @p cell; 8 if it has none there. */
    unsigned int corner(unsigned int cell, unsigned int node) const;

    bool share_a_cell(unsigned int a, unsigned int b) const;

    /** The node after @p b on the grid line that comes from @p a; no_node at its end. */
    unsigned int next(unsigned int a, unsigned int b) const;

    /** The grid line from @p a over @p b to its end, or @p n nodes of it. */
    std::vector<unsigned int> line(unsigned int a, unsigned int b, std::size_t n) const;
  };

  /** A face of the artificial boundary, by mesh nodes, with its cell. */
  struct ArtificialFace
  {
    std::array<unsigned int, 4> nodes;
    unsigned int                cell;
    Vector3                     normal; ///< outward
    double                      area;

    unsigned int rank() const ///< in the order in which lines are chosen
    {
      return std::abs(normal[2]) > .7 ? 2 : std::abs(normal[1]) > .7 ? 1 : 0;
    }
  };

  /** The faces of the artificial boundary of the region: those across x first, the bottom last. */
  std::vector<ArtificialFace> artificial_faces(const RockGrid &grid);

  /** Number of layers between each cell and the artificial boundary, 1 at the boundary. */
  std::vector<unsigned int> layers_of_cells(const RockGrid &grid, const std::vector<ArtificialFace> &faces);

  /** The node of the cell behind @p face that is joined to @p node. */
  unsigned int node_behind(const RockGrid &grid, const ArtificialFace &face, unsigned int node);
} // namespace Voussoir

#endif
