// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_sections_h
#define voussoir_sections_h

#include <voussoir/rock/rock_model.h>

namespace Voussoir
{
  /** For a mesh of one layer of cells: each node tied to the one at the same place but for @p direction. */
  std::vector<unsigned int> tie_layer(const HexMesh &mesh, unsigned int direction);

  /** One layer of cells behind the part of the artificial boundary of @p model that faces @p sense times
   * @p direction (0 = x, 1 = y): the section through the rock there, with artificial boundary where the other
   * artificial faces meet it. Empty if there is no such part. The model must not have tied nodes. */
  HexMesh extruded_section(const RockModel &model, unsigned int direction, int sense);
} // namespace Voussoir

#endif
