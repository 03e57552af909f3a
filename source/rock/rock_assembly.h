// SPDX-License-Identifier: GPL-3.0-or-later
// Assembly of a RockModel and its stiffness matrix, for rock_model.cc and rock_part.cc.
#ifndef voussoir_rock_assembly_h
#define voussoir_rock_assembly_h

#include <voussoir/rock/rock_grid.h>
#include <voussoir/rock/rock_model.h>

#include <functional>

namespace Voussoir
{
  using Corners = std::vector<std::array<unsigned int, 8>>; ///< nodes of each cell

  /** Returns the nodes of all cells. */
  Corners corners_of(const RockGrid &grid);

  /** Adds to @p nodes all nodes within @p n_layers layers of cells around them. */
  void add_layers(const Corners &cells, unsigned int n_layers, std::vector<bool> &nodes);

  /** Quadrature of the stiffness of a cell. */
  enum class Integration : unsigned char
  {
    nodal,
    gauss,
    with_modes, ///< Gauss points and incompatible modes, as in the dam
    nodal_plane ///< nodal in plane strain, where all corners are coupled
  };

  /** Assembles stiffness and mass of the @p model. @p rows: rows of the stiffness matrix that are filled;
   * other rows stay empty. */
  void assemble_rock(const RockGrid &grid, const Corners &cells, const std::vector<Integration> &kind,
                     const RockParameters &parameters, const std::vector<bool> &rows, RockModel &model);

  /** Returns per node whether its rows of the stiffness matrix are required. */
  using ChooseRows =
      std::function<std::vector<bool>(const RockGrid &, const Corners &, const std::vector<Integration> &,
                                      const std::vector<ArtificialFace> &)>;

  /** Creates the model as make_rock_model(), with the rows that @p choose returns, or with all rows if
   * @p choose is empty. */
  RockModel make_model_with_rows(const HexMesh &mesh, const RockParameters &parameters,
                                 const std::vector<unsigned int> &master, const ChooseRows &choose);
} // namespace Voussoir

#endif
