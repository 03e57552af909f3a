// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_nodal_mean_h
#define voussoir_nodal_mean_h

#include <voussoir/solid/material.h>

#include <array>
#include <vector>

namespace Voussoir
{
  class SolidModel;

  /** Rule by which stresses of cells become stresses of nodes: the mean of the cells of the stiffest material
   * around a node; on request, at nodes of the base, an extrapolation of the tractions on the base.
   *
   * An element of degree 1 gives tractions on planes parallel to its base as means over its height, so at a
   * node of the base they have an error of half an element. The tractions t_1, t_2 in the middles of the two
   * lowest elements, of heights h_1 and h_2, give t_0 = t_1 + h_1/(h_1 + h_2) (t_1 - t_2) on the base: exact
   * where the stress is linear. The strains along the base stay as they are (TractionCondition). Nodes above
   * a single layer of elements, and elements of degree 2, whose stresses are linear, have the mean alone. */
  class NodalMean
  {
  public:
    /** @p materials: as in assemble_structure(); @p to_base: extrapolate to the base? */
    NodalMean(const SolidModel &model, const std::vector<Material> &materials, bool to_base);

    /** What a cell adds to the mean at a node of the base: weight times its stress (xx yy zz xy yz zx). */
    struct Share
    {
      unsigned int           cell, local; ///< active cell, and which of its nodes the stress is taken at
      unsigned int           node;        ///< of the base
      std::array<double, 36> weight;      ///< 6 x 6, row by row
    };

    std::vector<Material>     material; ///< of each node: the stiffest one around it
    std::vector<unsigned int> n_cells;  ///< of each node: cells of that material
    std::vector<Share>        shares;   ///< ascending in the cells
  private:
    void add_base(const SolidModel &model, const std::vector<Material> &materials);
  };
} // namespace Voussoir

#endif
