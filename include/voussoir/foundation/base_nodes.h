// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_base_nodes_h
#define voussoir_base_nodes_h

#include <voussoir/solid/solid_model.h>

namespace Voussoir
{
  /** Base node: one rock node and the free dam nodes at its position. Each monolith that meets there has a
   * dam node, unless the monoliths share it. */
  struct BaseNode
  {
    unsigned int              rock;  ///< number of the rock node, see find_base_nodes()
    std::vector<unsigned int> nodes; ///< equation numbers of the dam nodes (SolidModel::equation), ascending
  };

  /** Returns the base nodes of the @p dam, ascending by rock node. Nodes coincide if their distance is at
   * most 1e-6 of the size of the base.
   *
   * @param dam model of the dam with free base nodes
   * @param points positions of the rock nodes [m]; BaseNode::rock is an index in this array
   * @param source name of the mesh in messages
   *
   * Throws InputError if a node of the dam base has no rock node. */
  std::vector<BaseNode> find_base_nodes(const SolidModel                         &dam,
                                        const std::vector<std::array<double, 3>> &points,
                                        const std::string                        &source);

  /** Returns the rock nodes of the base nodes, in the same order. */
  std::vector<unsigned int> rock_nodes(const std::vector<BaseNode> &base_nodes);

  /** All dam nodes on the foundation: the base nodes, seen from the dam. Several dam nodes may belong to one
   * base node. */
  struct DamNodes
  {
    DamNodes() = default; ///< no nodes

    /** Lists the dam nodes of all @p base_nodes. */
    explicit DamNodes(const std::vector<BaseNode> &base_nodes);

    /** Marks the dam nodes as interface nodes of their bodies. */
    void mark(Structure &structure) const;

    /** Expands a matrix from base nodes to dam nodes. Dam nodes on the same base node have equal rows and
     * columns.
     *
     * @param of_base matrix with one 3x3 block row per base node, such as a compliance [m/N]
     *
     * Returns the matrix with one block row per entry of node, in the same unit. */
    BlockSparseMatrix matrix(const BlockSparseMatrix &of_base) const;

    std::vector<unsigned int> node;      ///< equation numbers of the dam nodes, ascending
    std::vector<unsigned int> base_node; ///< per entry of node: index of its base node
  };
} // namespace Voussoir

#endif
