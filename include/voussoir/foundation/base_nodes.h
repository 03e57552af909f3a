// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_base_nodes_h
#define voussoir_base_nodes_h

#include <voussoir/solid/solid_model.h>

namespace Voussoir
{
  /** Base node: one rock node and the free dam nodes at its position. */
  struct BaseNode
  {
    unsigned int              rock;  ///< node number in the rock
    std::vector<unsigned int> nodes; ///< equation numbers in the dam
  };

  /** Returns the base nodes of the @p dam, ascending by rock node. @p points: positions of the rock nodes
   * [m].
   * @p source: name of the mesh in messages. Throws InputError if a node of the dam base has no rock node. */
  std::vector<BaseNode> find_base_nodes(const SolidModel                         &dam,
                                        const std::vector<std::array<double, 3>> &points,
                                        const std::string                        &source);

  /** Returns the rock nodes of the base nodes, in the same order. */
  std::vector<unsigned int> rock_nodes(const std::vector<BaseNode> &base_nodes);

  /** Dam nodes on the foundation. */
  struct DamNodes
  {
    DamNodes() = default;
    explicit DamNodes(const std::vector<BaseNode> &base_nodes);

    /** Marks the dam nodes as interface nodes of their bodies. */
    void mark(Structure &structure) const;

    /** Expands a matrix of the base nodes to the dam nodes. Dam nodes on the same base node have equal rows
     * and columns. */
    BlockSparseMatrix matrix(const BlockSparseMatrix &of_base) const;

    std::vector<unsigned int> node, base_node; ///< equations of the dam, ascending; base node below each
  };
} // namespace Voussoir

#endif
