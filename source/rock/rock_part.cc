// SPDX-License-Identifier: GPL-3.0-or-later
#include "rock_assembly.h"
#include <voussoir/rock/rock_part.h>

namespace Voussoir
{
  namespace
  {
    void join(const std::vector<bool> &more, std::vector<bool> &nodes)
    {
      for (std::size_t i = 0; i < nodes.size(); ++i)
        nodes[i] = nodes[i] || more[i];
    }

    /** Returns per node whether make_rock_part() fills its rows of the stiffness matrix. */
    std::vector<bool> needed_rows(const RockGrid &grid, const Corners &cells,
                                  const std::vector<Integration>    &kind,
                                  const std::vector<ArtificialFace> &faces,
                                  const std::vector<unsigned int> &find, const unsigned int n_layers)
    {
      constexpr unsigned int  of_coarse_space = 4; // layers
      const unsigned int      n = grid.n_nodes();
      const RockSplit         split(n);
      const std::vector<bool> none(n, false);
      std::vector<bool>       result = none, near = none;
      for (unsigned int i = 0; i < n; ++i)
        result[i] = split.owner(i) == Ranks::rank();
      add_layers(cells, of_coarse_space, result);
      for (const unsigned int i : find)
        near[i] = true;
      add_layers(cells, n_layers, near);
      join(near, result);
      for (const ArtificialFace &face : faces)
        for (const unsigned int v : face.corners)
          result[grid.node(face.cell, v)] = true;
      for (std::size_t k = 0; k < cells.size(); ++k)
        for (unsigned int v = 0; v < 8 && kind[k] != Integration::nodal; ++v)
          result[cells[k][v]] = true;
      return result;
    }
  } // namespace

  RockModel make_rock_part(const HexMesh &mesh, const RockParameters &parameters, const FindBaseNodes &find,
                           const unsigned int n_layers)
  {
    const auto choose = [&](const RockGrid &grid, const Corners &cells, const std::vector<Integration> &kind,
                            const std::vector<ArtificialFace> &faces)
    {
      const std::vector<unsigned int> found = find(grid.points);
      return Ranks::size() > 1 && nodal_kernel() != nullptr
                 ? needed_rows(grid, cells, kind, faces, found, n_layers)
                 : std::vector<bool>(grid.n_nodes(), true);
    };
    return make_model_with_rows(mesh, parameters, {}, choose);
  }
} // namespace Voussoir
