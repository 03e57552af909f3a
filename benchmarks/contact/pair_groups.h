// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_pair_groups_h
#define voussoir_pair_groups_h

#include <voussoir/base/node_matrix.h>
#include <voussoir/joints/interface_operator.h>

namespace Voussoir
{
  /** Groups of pairs that are coupled to the same pairs, such as those of one joint of an arch. The
   * permutation makes each group contiguous. */
  struct PairGroups
  {
    std::vector<unsigned int> order; ///< number in W of each reordered pair
    std::vector<unsigned int> size;  ///< number of pairs of each group
  };
  /** Returns the groups of the operator @p W. */
  PairGroups find_groups(const BlockSparseMatrix &W);

  /** Returns the symmetric operator @p W in dense blocks of @p groups. */
  InterfaceOperator make_interface_operator(const BlockSparseMatrix &W, const PairGroups &groups);
} // namespace Voussoir

#endif
