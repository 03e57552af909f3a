// SPDX-License-Identifier: GPL-3.0-or-later
// How a RockModel and its stiffness are put together, for rock_model.cc and rock_part.cc.
#ifndef voussoir_rock_assembly_h
#define voussoir_rock_assembly_h

#include <voussoir/rock/rock_grid.h>
#include <voussoir/rock/rock_model.h>

#include <functional>

namespace Voussoir
{
  using Corners = std::vector<std::array<unsigned int, 8>>; ///< nodes of the cells

  Corners corners_of(const RockGrid &grid);

  /** The @p nodes, and those within so many layers of cells around them. */
  void add_layers(const Corners &cells, unsigned int n_layers, std::vector<bool> &nodes);

  /** How the stiffness of a cell is integrated. */
  enum class Integration : unsigned char
  {
    nodal,
    gauss,
    with_modes ///< as the dam's elements
  };

  /** Stiffness and mass of the @p model. @p rows: of the stiffness; the others stay empty. */
  void assemble_rock(const RockGrid &grid, const Corners &cells, const std::vector<Integration> &kind,
                     const RockParameters &parameters, const std::vector<bool> &rows, RockModel &model);

  /** Rows of the stiffness that are needed, by node. */
  using ChooseRows =
      std::function<std::vector<bool>(const RockGrid &, const Corners &, const std::vector<Integration> &,
                                      const std::vector<ArtificialFace> &)>;

  /** make_rock_model() with these rows; without a choice, all. */
  RockModel make_model_with_rows(const HexMesh &mesh, const RockParameters &parameters,
                                 const std::vector<unsigned int> &master, const ChooseRows &choose);
} // namespace Voussoir

#endif
