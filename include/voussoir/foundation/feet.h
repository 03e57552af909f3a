// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_feet_h
#define voussoir_feet_h

#include <voussoir/solid/solid_model.h>

namespace Voussoir
{
  /** Base node: one rock node and the free dam nodes at its position. */
  struct Foot
  {
    unsigned int              rock;  ///< node number in the rock
    std::vector<unsigned int> nodes; ///< equation numbers in the dam
  };

  /** Returns the base nodes of the @p dam, ascending by rock node. @p points: positions of the rock nodes
   * [m].
   * @p source: name of the mesh in messages. Throws InputError if a node of the dam base has no rock node. */
  std::vector<Foot> find_feet(const SolidModel &dam, const std::vector<std::array<double, 3>> &points,
                              const std::string &source);

  /** Dam nodes on the foundation. */
  struct StandingNodes
  {
    StandingNodes() = default;
    explicit StandingNodes(const std::vector<Foot> &feet);

    /** Marks the dam nodes as interface nodes of their bodies. */
    void mark(Structure &structure) const;

    /** Expands a matrix of the base nodes to the dam nodes. Dam nodes on the same base node have equal rows
     * and columns. */
    BlockSparseMatrix matrix(const BlockSparseMatrix &of_feet) const;

    std::vector<unsigned int> node, foot; ///< equations of the dam, ascending; base node below each
  };
} // namespace Voussoir

#endif
