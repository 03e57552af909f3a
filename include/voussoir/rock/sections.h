// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_sections_h
#define voussoir_sections_h

#include <voussoir/rock/rock_model.h>

namespace Voussoir
{
  /** Returns the master of each node of a mesh with one layer of cells. Nodes whose positions differ in
   * @p direction only (0: x, 1: y, 2: z) have the same master. */
  std::vector<unsigned int> tie_layer(const HexMesh &mesh, unsigned int direction);

  /** Returns the section through the rock behind one side of the artificial boundary, extruded to one layer
   * of cells. The side has the outward normal @p sense times @p direction (0: x, 1: y). The section has an
   * artificial boundary where other artificial faces meet the side. The mesh is empty if there is no such
   * side. The model must not have tied nodes. */
  HexMesh extruded_section(const RockModel &model, unsigned int direction, int sense);
} // namespace Voussoir

#endif
