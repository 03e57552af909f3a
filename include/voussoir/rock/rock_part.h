// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_part_h
#define voussoir_rock_part_h

#include <voussoir/rock/rock_model.h>

#include <functional>

namespace Voussoir
{
  /** The nodes under the dam, from the places of all nodes of the rock [m]. */
  using FindFeet = std::function<std::vector<unsigned int>(const std::vector<Vector3> &)>;

  /** The rock's model as make_rock_model() makes it, but with several ranks its stiffness has only the rows
   * that this rank needs; the others are empty. They are those of
   *  - its own nodes, as RockSplit shares them out, and of nodes within four layers of cells around them,
   *    for the coarse space of the static state: coarse_rows() goes two layers beyond aggregates, which go
   * two beyond their seeds;
   *  - nodes within @p n_layers of the @p feet, which all ranks need, and of the artificial boundary;
   *  - nodes whose cells are not all nodal: RockOperator takes their rows from the matrix. */
  RockModel make_rock_part(const HexMesh &mesh, const RockParameters &parameters, const FindFeet &feet,
                           unsigned int n_layers);
} // namespace Voussoir

#endif
