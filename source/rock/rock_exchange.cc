// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the stiffness operator of a region on several MPI processes, and the exchange of their forces.

#include "rock_numbering.h"

#include <numeric>

namespace Voussoir
{
  void RockOperator::Numbering::share_blocks(const std::vector<std::size_t> &ends, const RockSplit &split)
  {
    const unsigned int  n_blocks = ends.size(), n_ranks = Ranks::size();
    std::vector<double> sum(n_blocks, 0.), count(n_blocks, 0.);
    for (const auto &[i, b] : in_block)
    {
      sum[b] += i;
      count[b] += 1.;
    }
    std::vector<unsigned int> by_place(n_blocks);
    std::iota(by_place.begin(), by_place.end(), 0);
    std::sort(by_place.begin(), by_place.end(),
              [&](const unsigned int a, const unsigned int b)
              { return std::make_pair(sum[a] / count[a], a) < std::make_pair(sum[b] / count[b], b); });
    std::vector<std::size_t> until(n_ranks, 0); // nodes with nodal cells that this and lower processes own
    for (unsigned int i = 0; i < kind.size(); ++i)
      if (kind[i] != of_matrix)
        ++until[split.owner(i)];
    std::partial_sum(until.begin(), until.end(), until.begin());
    rank.resize(n_blocks);
    std::size_t before = 0;
    for (const unsigned int b : by_place)
    {
      const std::size_t n = ends[b] - (b == 0 ? 0 : ends[b - 1]);
      const std::size_t middle = (2 * before + n) * until.back() / (2 * ends.back());
      rank[b] = std::upper_bound(until.begin(), until.end() - 1, middle) - until.begin();
      before += n;
    }
  }

  void RockOperator::find_partners(const RockSplit &split, const Numbering &numbering)
  {
    const unsigned int              me = Ranks::rank();
    std::map<unsigned int, Partner> found;
    const auto                      give = [&](const unsigned int from, const unsigned int i, const auto &at)
    {
      for (unsigned int r = 0; r < Ranks::size(); ++r)
        if (r != from && (r == me || from == me) && split.is_stepped(i, r))
        {
          Partner &partner = found[r == me ? from : r];
          partner.rank = r == me ? from : r;
          (r == me ? partner.receive : partner.send).push_back(at());
        }
    };
    for (const auto &[i, b] : numbering.in_block)
      if (numbering.kind[i] == Numbering::own)
        give(numbering.rank[b], i, [&, i = i] { return 3 * std::size_t(i); });
      else if (numbering.kind[i] == Numbering::shared)
        give(numbering.rank[b], i,
             [&, i = i, b = b] {
               return 3 * (std::size_t(n_nodes) + numbering.place.at({i, b}));
             });
    for (unsigned int i = 0; i < n_nodes; ++i)
      if (numbering.kind[i] == Numbering::of_matrix)
        give(split.owner(i), i, [&] { return 3 * std::size_t(i); });
    for (auto &[r, partner] : found)
    {
      partner.out.resize(3 * partner.send.size());
      partner.in.resize(3 * partner.receive.size());
      partners.push_back(std::move(partner));
    }
  }

  /** Packs the forces of the cells of this process on nodes that others integrate. */
  void RockOperator::pack_forces(const double *y, std::vector<Ranks::Message> &messages) const
  {
    const std::size_t n = 3 * std::size_t(n_nodes);
    for (const Partner &partner : partners)
    {
      for (std::size_t k = 0; k < partner.send.size(); ++k)
      {
        const std::size_t at = partner.send[k];
        std::copy_n(at < n ? y + at : shared_force.data() + at - n, 3, partner.out.begin() + 3 * k);
      }
      messages.push_back(
          {partner.rank, partner.out.data(), partner.out.size(), partner.in.data(), partner.in.size()});
    }
  }

  /** Adds the forces of the cells of other processes on the nodes of this process. */
  void RockOperator::unpack_forces(double *y) const
  {
    const std::size_t n = 3 * std::size_t(n_nodes);
    for (const Partner &partner : partners)
      for (std::size_t k = 0; k < partner.receive.size(); ++k)
      {
        const std::size_t at = partner.receive[k];
        std::copy_n(partner.in.begin() + 3 * k, 3, at < n ? y + at : shared_force.data() + at - n);
      }
  }
} // namespace Voussoir
