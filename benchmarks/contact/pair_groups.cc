// SPDX-License-Identifier: GPL-3.0-or-later
#include "pair_groups.h"

#include <algorithm>
#include <map>

namespace Voussoir
{
  PairGroups find_groups(const BlockSparseMatrix &W)
  {
    std::map<std::vector<unsigned int>, std::vector<unsigned int>> groups; // columns -> rows
    for (unsigned int i = 0; i < W.n_rows(); ++i)
      groups[std::vector<unsigned int>(W.column.begin() + W.start[i], W.column.begin() + W.start[i + 1])]
          .push_back(i);
    PairGroups result;
    for (const auto &group : groups)
    {
      result.size.push_back(static_cast<unsigned int>(group.second.size()));
      result.order.insert(result.order.end(), group.second.begin(), group.second.end());
    }
    return result;
  }

  InterfaceOperator make_interface_operator(const BlockSparseMatrix &W, const PairGroups &groups)
  {
    InterfaceOperator         result(groups.size);
    std::vector<unsigned int> place(W.n_rows()), group(W.n_rows()); // per pair of W
    for (unsigned int g = 0, next = 0; g < groups.size.size(); ++g)
    {
      result.block(g, g);
      for (unsigned int i = 0; i < groups.size[g]; ++i, ++next)
      {
        place[groups.order[next]] = next;
        group[groups.order[next]] = g;
      }
    }
    for (unsigned int i = 0; i < W.n_rows(); ++i)
      for (std::size_t k = W.start[i]; k < W.start[i + 1]; ++k)
      {
        const unsigned int j = W.column[k];
        if (group[i] > group[j])
          continue;
        std::vector<double> &block = result.block(group[i], group[j]);
        const std::size_t    rows = result.size(group[i]), row = 3 * place[i] - result.begin(group[i]),
                          column = 3 * place[j] - result.begin(group[j]);
        for (unsigned int r = 0; r < 3; ++r)
          for (unsigned int c = 0; c < 3; ++c)
            block[(column + c) * rows + row + r] = W.value[k][3 * r + c];
      }
    result.finish();
    return result;
  }
} // namespace Voussoir
