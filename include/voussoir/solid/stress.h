// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_stress_h
#define voussoir_stress_h

#include <voussoir/solid/material.h>
#include <voussoir/solid/node_faces.h>
#include <voussoir/solid/structure.h>

#include <array>

namespace Voussoir
{
  class NodalMean;
  class SolidModel;

  using Stress = std::array<float, 6>; ///< xx yy zz xy yz zx [Pa], tension > 0

  /** Largest and smallest principal stress. */
  std::array<float, 2> principal_stresses(const Stress &s);

  /** Stress at all nodes from the displacements of the free ones and the known tractions on faces, as sparse
   * products. First in each cell as CellElasticity::stress_operator(), then the mean of the cells of the same
   * monolith around a node; where materials meet, of those of the stiffest (largest modulus of elasticity):
   * stresses along the interface jump there, and the stiffest has the largest. On request the tractions on
   * the base are extrapolated to its nodes (NodalMean). Then, at nodes of faces with
   * known tractions, the nearest stress (by the energy of the difference) that has these: strains along the
   * faces stay, see TractionCondition. Held and applied in single precision (1e-7 of the stress): it is read
   * at every recorded step. */
  class StressRecovery
  {
  public:
    /** @p materials: as in assemble_structure(); @p faces: with known tractions, ascending in their nodes;
     * @p to_base: extrapolate the tractions to the base? */
    StressRecovery(const SolidModel &model, const std::vector<Material> &materials, bool incompatible_modes,
                   const std::vector<NodeFace> &faces = {}, bool to_base = false);

    /** @p u: 3 per free node [m]; @p tractions: force per area on each of the faces [Pa], empty where all are
     * zero; result: one per node of the model. */
    void apply(const Unknowns &u, const std::vector<Vector3> &tractions, std::vector<Stress> &stress) const
    {
      apply(u, tractions, 0, start.size() - 1, stress);
    }

    /** Only at the nodes from @p first to before @p last. */
    void apply(const Unknowns &u, const std::vector<Vector3> &tractions, std::size_t first, std::size_t last,
               std::vector<Stress> &stress) const;

    double memory() const { return 4. * 18. * (blocks.size() + of_traction.size()); } ///< [bytes]

  private:
    void find_columns(const SolidModel &model, const NodalMean &mean);
    void add_cells(const SolidModel &model, const std::vector<Material> &materials, bool incompatible_modes,
                   const NodalMean &mean);
    void condition(const std::vector<NodeFace> &faces, const NodalMean &mean);
    std::array<float, 18> &block(unsigned int node, unsigned int free_node);

    std::vector<std::size_t>           start;
    std::vector<unsigned int>          column; ///< free node
    std::vector<std::array<float, 18>> blocks; ///< stress component 0..5 by displacement component x, y, z
    std::vector<std::array<float, 18>> of_traction;  ///< per face: stress of its node by traction
    std::vector<unsigned int>          node_of_face; ///< that node
  };
} // namespace Voussoir

#endif
