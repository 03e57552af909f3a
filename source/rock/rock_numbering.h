// SPDX-License-Identifier: GPL-3.0-or-later
// Data that the steps of the construction of RockOperator share.
#ifndef voussoir_rock_numbering_h
#define voussoir_rock_numbering_h

#include <voussoir/rock/rock_operator.h>

#include <algorithm>
#include <map>

namespace Voussoir
{
  struct RockOperator::Numbering
  {
    enum Kind : unsigned int
    {
      own,
      shared,
      of_matrix
    };
    std::vector<std::pair<unsigned int, unsigned int>> in_block; ///< pairs of node and block, ascending
    std::vector<unsigned int>                          rank;     ///< process of each block
    std::map<std::pair<unsigned int, unsigned int>, unsigned int>
                              place; ///< index of the force of a shared node, by node and block
    std::vector<Kind>         kind;  ///< per node of the region
    std::vector<unsigned int> local; ///< per node: number in the current block

    std::map<std::array<double, 2 * NodalPacks::n_lanes>, unsigned int>
        lame; ///< index of each set of constants

    /** Sets the kind of each node from the blocks that contain it. */
    Numbering(const std::vector<NodalCell> &cells, const std::vector<unsigned int> &order,
              const std::vector<std::size_t> &ends, const std::vector<bool> &has_row)
        : kind(has_row.size(), own), local(has_row.size())
    {
      constexpr unsigned int    none = static_cast<unsigned int>(-1);
      std::vector<unsigned int> block(has_row.size(), none);
      std::size_t               k = 0;
      for (unsigned int b = 0; b < ends.size(); ++b)
        for (; k < ends[b]; ++k)
          for (const unsigned int i : cells[order[k]].nodes)
          {
            if (block[i] != none && block[i] != b)
              kind[i] = shared;
            if (block[i] != b)
              in_block.emplace_back(i, b);
            block[i] = b;
          }
      std::sort(in_block.begin(), in_block.end());
      in_block.erase(std::unique(in_block.begin(), in_block.end()), in_block.end());
      for (std::size_t i = 0; i < has_row.size(); ++i)
        if (has_row[i])
          kind[i] = of_matrix;
    }

    /** Distributes the blocks in the order of their node numbers. The share of cells of a process is its
     * share of the nodes whose forces are computed from cells. */
    void share_blocks(const std::vector<std::size_t> &ends, const RockSplit &split);
  };
} // namespace Voussoir

#endif
