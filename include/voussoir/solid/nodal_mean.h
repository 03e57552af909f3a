// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_nodal_mean_h
#define voussoir_nodal_mean_h

#include <voussoir/solid/material.h>

#include <array>
#include <vector>

namespace Voussoir
{
  class SolidModel;

  /** Averaging rule for nodal stresses. The stress of a node is the mean over the cells around it that have
   * the stiffest material. On request, the tractions on the base are extrapolated at base nodes.
   *
   * In an element of degree 1 the tractions on planes parallel to the base are means over the element height.
   * At a base node they have an error of half an element. Let t_1 and t_2 be the tractions in the middle of
   * the two lowest elements, of heights h_1 and h_2. The traction on the base is t_0 = t_1 + h_1/(h_1 + h_2)
   * (t_1 - t_2), which is exact for a linear stress. The strains parallel to the base are unchanged
   * (TractionCondition). Elements of degree 2, whose stresses are linear, and nodes above a single layer of
   * elements have the mean only. */
  class NodalMean
  {
  public:
    /** @param model mesh of the bodies
     * @param materials as in assemble_structure()
     * @param to_base whether to extrapolate the tractions to the base */
    NodalMean(const SolidModel &model, const std::vector<Material> &materials, bool to_base);

    /** Contribution of the stress of a cell to the stress of a base node: weight times stress (xx yy zz
     * xy yz zx). */
    struct Share
    {
      unsigned int cell, local; ///< active cell, and local number of the node at which its stress is taken
      unsigned int node;        ///< base node that receives the contribution
      std::array<double, 36> weight; ///< 6 x 6, row by row
    };

    std::vector<Material>     material; ///< stiffest material around each node
    std::vector<unsigned int> n_cells;  ///< number of cells of that material around each node
    std::vector<Share>        shares;   ///< sorted by cell
  private:
    void add_base(const SolidModel &model, const std::vector<Material> &materials);
  };
} // namespace Voussoir

#endif
