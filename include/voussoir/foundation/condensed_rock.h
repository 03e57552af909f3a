// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_condensed_rock_h
#define voussoir_condensed_rock_h

#include <voussoir/foundation/base_nodes.h>
#include <voussoir/foundation/foundation_parameters.h>
#include <voussoir/mesh/mesh.h>

namespace Voussoir
{
  /** Stiffness of massless rock, condensed to the base nodes of the dam. Components are x, y, z in the axes
   * of the mesh. */
  struct CondensedRock
  {
    std::vector<BaseNode> base_nodes; ///< base nodes, ascending by rock node
    std::vector<double>   stiffness;  ///< S, dense n() x n(), three rows per base node, symmetric [N/m]

    /** Returns S with one block row per base node [N/m]. */
    BlockSparseMatrix matrix() const;

    /** Returns the number of rows of S, three per base node. */
    unsigned int n() const { return 3 * static_cast<unsigned int>(base_nodes.size()); }

    /** Returns (S - springs)^-1 with one block row per base node [m/N]. @p springs: diagonal matrix, one
     * value per base node for all three components [N/m]. Throws ComputationError if the difference is not
     * positive definite. */
    BlockSparseMatrix compliance(const std::vector<double> &springs) const;
  };

  /** Condenses the rock of a mesh, fixed at its artificial boundary. The first rank computes for all ranks,
   * and all ranks must call the function.
   *
   * @param parameters materials of the rock
   * @param mesh mesh of dam and rock
   * @param dam model of the dam with free base nodes
   * @param incompatible_modes true: rock elements of degree 1 have incompatible modes
   * @param source name of the mesh in messages
   *
   * Throws InputError if a base node has no rock node, or if the artificial boundary has no face. Throws
   * ComputationError if the stiffness matrix of the rock cannot be factorised. */
  CondensedRock condense_rock(const FoundationParameters &parameters, const HexMesh &mesh,
                              const SolidModel &dam, bool incompatible_modes, const std::string &source);
} // namespace Voussoir

#endif
