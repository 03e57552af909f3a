// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_condensed_rock_h
#define voussoir_condensed_rock_h

#include <voussoir/foundation/feet.h>
#include <voussoir/foundation/foundation_parameters.h>
#include <voussoir/mesh/mesh.h>

namespace Voussoir
{
  /** The stiffness of rock without mass, condensed to the nodes of the dam's base. */
  struct CondensedRock
  {
    std::vector<Foot>   feet;
    std::vector<double> stiffness; ///< S, three rows and columns per foot, symmetric [N/m]

    BlockSparseMatrix matrix() const; ///< S

    unsigned int n() const { return 3 * static_cast<unsigned int>(feet.size()); }

    /** (S - springs)^-1 [m/N], @p springs on the diagonal, the same for the three components, per foot
     * [N/m]. ComputationError where that is not positive definite. */
    BlockSparseMatrix compliance(const std::vector<double> &springs) const;
  };

  /** That of the rock of @p mesh, fixed at its artificial boundary; @p dam: its base free; @p source names
   * the mesh. By the first rank for all. Throws InputError where a node of the base has no rock,
   * ComputationError where nothing holds the rock. */
  CondensedRock condense_rock(const FoundationParameters &parameters, const HexMesh &mesh,
                              const SolidModel &dam, bool incompatible_modes, const std::string &source);
} // namespace Voussoir

#endif
