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

  /** Section with a zone of cells beyond its artificial faces, and the free field of the nodes. */
  struct WideSection
  {
    HexMesh                   mesh; ///< nodes and cells of the section come first
    std::vector<unsigned int> root; ///< per node: node of the section from which it was extruded, or itself
    std::vector<bool>         is_below; ///< per node: whether the extrusion of root went downward, too
    std::size_t               n_nodes, n_cells; ///< of the section
    unsigned int              n_layers = 0;     ///< largest number of layers of the zone on a side
  };

  /** Returns a section with a zone of cells beside and below. The cells of the zone have the size of the
   * outermost cells of the section. The faces of the section are replaced by those of the zone.
   * @param section result of extruded_section() with the same @p direction
   * @param direction of the section
   * @param width width of the zone, rounded to whole cells [m]
   * @param least least number of layers on each side */
  WideSection widened(const HexMesh &section, unsigned int direction, double width, unsigned int least);
} // namespace Voussoir

#endif
