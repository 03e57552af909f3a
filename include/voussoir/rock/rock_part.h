// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_part_h
#define voussoir_rock_part_h

#include <voussoir/rock/rock_model.h>

#include <functional>

namespace Voussoir
{
  /** Returns the base nodes of the dam, given the positions of all rock nodes [m]. */
  using FindBaseNodes = std::function<std::vector<unsigned int>(const std::vector<Vector3> &)>;

  /** Creates the rock model for this MPI process. It equals that of make_rock_model(), but with several
   * processes only the required rows of the stiffness matrix are filled. These are the rows of
   * - the nodes that RockSplit assigns to this process, and the nodes within four layers of cells around
   *   them. The coarse space of the static state requires them: coarse_rows() reaches two layers beyond
   *   aggregates, and aggregates reach two layers beyond their seeds;
   * - the nodes within @p n_layers layers of the base nodes, which all processes require. @p find returns the
   *   base nodes;
   * - the nodes of the artificial boundary;
   * - the nodes with cells of other than nodal quadrature, for which RockOperator uses matrix rows. */
  RockModel make_rock_part(const HexMesh &mesh, const RockParameters &parameters, const FindBaseNodes &find,
                           unsigned int n_layers);
} // namespace Voussoir

#endif
