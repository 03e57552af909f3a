// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts of RockOperator's construction tell each other.
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
    std::vector<std::pair<unsigned int, unsigned int>> in_block; ///< nodes and their blocks, ascending
    std::vector<unsigned int>                          rank;     ///< of the blocks
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> place; ///< of shared nodes' forces
    std::vector<Kind>                                             kind;  ///< of the region's nodes
    std::vector<unsigned int>                                     local; ///< number in the block at hand

    std::map<std::array<double, 2 * NodalPacks::n_lanes>, unsigned int> lame; ///< places of the sets

    /** Kinds from the blocks that nodes are in. */
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

    /** Blocks in the order of their nodes' numbers; each rank gets as many cells as it has of the nodes
     * whose forces come from cells. */
    void share_blocks(const std::vector<std::size_t> &ends, const RockSplit &split);
  };
} // namespace Voussoir

#endif
