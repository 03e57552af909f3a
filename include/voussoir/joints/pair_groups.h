// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_pair_groups_h
#define voussoir_pair_groups_h

#include <voussoir/base/node_matrix.h>
#include <voussoir/joints/interface_operator.h>

namespace Voussoir
{
  /** Groups of pairs that are coupled to the same pairs, such as those of one joint of an arch: a permutation
   *  that makes each group contiguous, and their sizes. */
  struct PairGroups
  {
    std::vector<unsigned int> order; ///< new pair -> old pair
    std::vector<unsigned int> size;  ///< of each group [pairs]
  };
  PairGroups find_groups(const BlockSparseMatrix &W);

  /** The operator as one sparse matrix, joint after joint. */
  BlockSparseMatrix sparse_matrix(const InterfaceOperator &W);

  /** W between surfaces of pairs: rows are the axes of surface k of pair p, for each entry (p, axes) of
   *  @p surfaces, in the order of the pairs. */
  BlockSparseMatrix sparse_matrix(const BlockSparseMatrix                             &W,
                                  const std::vector<std::pair<unsigned int, Matrix3>> &surfaces);

  /** The same operator in dense blocks by group; @p W symmetric. */
  InterfaceOperator make_interface_operator(const BlockSparseMatrix &W, const PairGroups &groups);
} // namespace Voussoir

#endif
