// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/rock/rock_split.h>

#include <algorithm>
#include <numeric>

namespace Voussoir
{
  RockSplit::RockSplit(const std::vector<double> &work) : n_nodes(work.size())
  {
    const unsigned int n_ranks = Ranks::size();
    const std::size_t  n = n_nodes;
    if (n_ranks == 1)
      return;
    const std::size_t   n_chunks = (n + per_chunk - 1) / per_chunk;
    std::vector<double> before(1, 0.); // cumulative work of the chunks
    for (std::size_t c = 0; c < n_chunks; ++c)
      before.push_back(std::accumulate(work.begin() + c * per_chunk,
                                       work.begin() + std::min<std::size_t>(n, (c + 1) * per_chunk),
                                       before.back()));
    begin.push_back(0);
    for (unsigned int r = 1; r < n_ranks; ++r)
    {
      const double part = before.back() * r / n_ranks;
      const auto   above = std::upper_bound(before.begin() + 1, before.end() - 1, part);
      begin.push_back(above - before.begin() - (part - above[-1] < *above - part));
    }
    begin.push_back(n_chunks);
    for (unsigned int r = 0; r < n_ranks; ++r)
    {
      steps.emplace_back(n, false);
      for (std::size_t i = begin[r] * per_chunk; i < std::min<std::size_t>(n, begin[r + 1] * per_chunk); ++i)
        steps[r][i] = true;
    }
  }

  unsigned int RockSplit::owner(const unsigned int node) const
  {
    if (begin.empty())
      return Ranks::rank();
    return std::upper_bound(begin.begin(), begin.end(), node / per_chunk) - begin.begin() - 1;
  }

  void RockSplit::step_everywhere(const std::vector<unsigned int> &nodes)
  {
    for (unsigned int r = 0; r < steps.size(); ++r)
      step(nodes, r);
  }

  void RockSplit::step(const std::vector<unsigned int> &nodes, const unsigned int rank)
  {
    for (const unsigned int i : nodes)
      steps[rank][i] = true;
  }

  void RockSplit::follow_lines()
  {
    for (auto &of_rank : steps)
      for (bool more = true; more;) // a line may begin on a line of another face
      {
        more = false;
        for (const auto &line : lines)
          if (of_rank[line[0]])
            for (const unsigned int i : line)
              if (!of_rank[i])
                more = of_rank[i] = true;
      }
  }

  std::vector<std::pair<int, int>> RockSplit::pieces(const int n) const
  {
    std::vector<std::pair<int, int>> result;
    for (int i = 0; i < n; ++i)
      if (is_trivial() || is_stepped(i))
      {
        if (result.empty() || result.back().second != i || i % per_chunk == 0)
          result.emplace_back(i, i);
        ++result.back().second;
      }
    return result;
  }

  void RockSplit::gather(std::vector<double> &data, const unsigned int n) const
  {
    if (is_trivial() || data.empty())
      return;
    std::vector<std::size_t> parts;
    for (const std::size_t chunk : begin)
      parts.push_back(n * std::min<std::size_t>(n_nodes, chunk * per_chunk));
    Ranks::gather(data.data(), parts);
  }

  void RockSplit::gather_chunks(std::vector<double> &data, const unsigned int n) const
  {
    if (is_trivial())
      return;
    std::vector<std::size_t> parts;
    for (const std::size_t chunk : begin)
      parts.push_back(n * chunk);
    Ranks::gather(data.data(), parts);
  }

  void RockSplit::gather(std::vector<double> &data, const unsigned int n,
                         const std::vector<unsigned int> &node) const
  {
    if (is_trivial() || data.empty())
      return;
    // In the order of the owners, so that the items of each process are contiguous.
    std::vector<std::vector<std::size_t>> items(Ranks::size());
    for (std::size_t i = 0; i < node.size(); ++i)
      items[owner(node[i])].push_back(i);
    std::vector<double>      packed(data.size());
    std::vector<std::size_t> parts(1, 0);
    for (const auto &list : items)
    {
      std::size_t to = parts.back();
      for (const std::size_t i : list)
        for (unsigned int k = 0; k < n; ++k)
          packed[to++] = data[n * i + k];
      parts.push_back(to);
    }
    Ranks::gather(packed.data(), parts);
    std::size_t from = 0;
    for (const auto &list : items)
      for (const std::size_t i : list)
        for (unsigned int k = 0; k < n; ++k)
          data[n * i + k] = packed[from++];
  }
} // namespace Voussoir
