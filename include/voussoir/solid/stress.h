// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_stress_h
#define voussoir_stress_h

#include <voussoir/solid/material.h>
#include <voussoir/solid/structure.h>

#include <array>

namespace Voussoir
{
  class SolidModel;

  using Stress = std::array<float, 6>; ///< xx yy zz xy yz zx [Pa], tension > 0

  /** Largest and smallest principal stress. */
  std::array<float, 2> principal_stresses(const Stress &s);

  /** Stress at all nodes from the displacements of the free ones, as one sparse product. In each cell as
   *  CellElasticity::stress_operator(), then the mean of the cells of the same monolith around a node;
   *  where materials meet, of those of the stiffest (largest modulus of elasticity): stresses along the
   *  interface jump there, and the stiffest has the largest. Held and applied in single precision (1e-7 of
   * the stress): it is read at every recorded step. */
  class StressRecovery
  {
  public:
    /** @p materials: as in assemble_structure(). */
    StressRecovery(const SolidModel &model, const std::vector<Material> &materials, bool incompatible_modes);

    /** @p u: 3 per free node [m]; result: one per node of the model. */
    void apply(const Unknowns &u, std::vector<Stress> &stress) const;

    double memory() const { return 4. * 18. * blocks.size(); } ///< [bytes]

  private:
    std::vector<std::size_t>           start;
    std::vector<unsigned int>          column; ///< free node
    std::vector<std::array<float, 18>> blocks; ///< stress component 0..5 by displacement component x, y, z
  };
} // namespace Voussoir

#endif
