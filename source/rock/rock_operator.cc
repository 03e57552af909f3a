// SPDX-License-Identifier: GPL-3.0-or-later
#include "rock_numbering.h"
#include <voussoir/base/error.h>
#include <voussoir/mesh/mesh.h>

#include <algorithm>
#include <memory>

#ifdef _OPENMP
#include <omp.h>
#endif

namespace Voussoir
{
  namespace
  {
    constexpr unsigned int n_lanes = NodalPacks::n_lanes;

    /** Returns the number of blocks for @p n_cells cells. A block has 2048 cells; its nodes and forces take
     * about 240 kB. Small regions have smaller blocks, to supply several threads. */
    std::size_t number_of_blocks(const std::size_t n_cells)
    {
      constexpr std::size_t most_cells = 2048, least_cells = 256, enough = 16;
      static_assert(4 * (8 * most_cells - 1) <= 65535, "NodalPacks::corner has 16 bits");
      const auto blocks_of = [&](const std::size_t n) { return (n_cells + n - 1) / n; };
      return std::max(blocks_of(most_cells), std::min(blocks_of(least_cells), enough));
    }

    /** Sorts @p cells from @p begin to @p end into @p n_blocks boxes of full packs, by repeated bisection of
     * the longest side. Appends the ends of the boxes. */
    void sort_into_blocks(const std::vector<Vector3> &centre, std::vector<unsigned int> &cells,
                          const std::size_t begin, const std::size_t end, const std::size_t n_blocks,
                          std::vector<std::size_t> &ends)
    {
      if (n_blocks < 2)
      {
        std::sort(cells.begin() + begin, cells.begin() + end);
        ends.push_back(end);
        return;
      }
      Vector3 low = centre[cells[begin]], high = low;
      for (std::size_t i = begin; i < end; ++i)
        for (unsigned int c = 0; c < 3; ++c)
        {
          low[c] = std::min(low[c], centre[cells[i]][c]);
          high[c] = std::max(high[c], centre[cells[i]][c]);
        }
      const Vector3      size = high - low;
      const unsigned int d = std::max_element(size.begin(), size.end()) - size.begin();
      const std::size_t  n_first = n_blocks / 2;
      const std::size_t  middle = begin + (end - begin) * n_first / n_blocks / n_lanes * n_lanes;
      std::nth_element(cells.begin() + begin, cells.begin() + middle, cells.begin() + end,
                       [&](const unsigned int i, const unsigned int j)
                       { return centre[i][d] != centre[j][d] ? centre[i][d] < centre[j][d] : i < j; });
      sort_into_blocks(centre, cells, begin, middle, n_first, ends);
      sort_into_blocks(centre, cells, middle, end, n_blocks - n_first, ends);
    }
  } // namespace

  namespace
  {
    RockSplit &no_split()
    {
      static RockSplit split;
      return split;
    }
  } // namespace

  RockOperator::RockOperator(const BlockSparseMatrix &stiffness, const std::vector<Vector3> &points,
                             const std::vector<NodalCell> &cells, const std::vector<bool> &keeps_row,
                             const NodalKernel kernel)
      : RockOperator(stiffness, points, cells, keeps_row, kernel, no_split())
  {
  }

  RockOperator::RockOperator(const BlockSparseMatrix &stiffness, const std::vector<Vector3> &points,
                             const std::vector<NodalCell> &cells, const std::vector<bool> &keeps_row,
                             const NodalKernel kernel, RockSplit &split)
      : kernel(kernel), n_nodes(stiffness.n_rows())
  {
    const std::vector<bool>   has_row = kernel ? keeps_row : std::vector<bool>(n_nodes, true);
    std::vector<unsigned int> order;
    std::vector<Vector3>      centre(cells.size(), Vector3{}); // sum of eight corners
    for (unsigned int k = 0; k < cells.size(); ++k)
    {
      const auto &nodes = cells[k].nodes;
      for (const unsigned int i : nodes)
        add(centre[k], points[i]);
      if (!std::all_of(nodes.begin(), nodes.end(), [&](const unsigned int i) { return has_row[i]; }))
        order.push_back(k);
    }
    std::vector<std::size_t> ends;
    if (!order.empty())
      sort_into_blocks(centre, order, 0, order.size(), number_of_blocks(order.size()), ends);
    Numbering numbering(cells, order, ends, has_row);
    if (!split.is_trivial())
    {
      numbering.share_blocks(ends, split);
      for (const auto &[i, b] : numbering.in_block)
        split.step({i}, numbering.rank[b]);
      for (unsigned int i = 0; i < n_nodes; ++i)
        if (has_row[i])
          split.step({stiffness.column.begin() + stiffness.start[i],
                      stiffness.column.begin() + stiffness.start[i + 1]},
                     split.owner(i));
      split.follow_lines();
    }
    std::vector<bool> keeps = has_row;
    for (unsigned int i = 0; i < n_nodes; ++i)
      keeps[i] = has_row[i] && split.owner(i) == Ranks::rank();
    keep_rows(stiffness, keeps);
    std::size_t first = 0;
    for (unsigned int b = 0; b < ends.size(); ++b)
    {
      if (split.is_trivial() || numbering.rank[b] == Ranks::rank())
      {
        add_block(cells, {order.begin() + first, order.begin() + ends[b]}, points, numbering);
        blocks.back().number = b;
      }
      first = ends[b];
    }
    find_shared_nodes(split, numbering);
    if (!split.is_trivial())
      find_partners(split, numbering);
  }

  void RockOperator::keep_rows(const BlockSparseMatrix &stiffness, const std::vector<bool> &has_row)
  {
    start.push_back(0);
    for (unsigned int i = 0; i < n_nodes; ++i)
      if (has_row[i])
      {
        row.push_back(i);
        start.push_back(start.back() + stiffness.start[i + 1] - stiffness.start[i]);
      }
    column.reserve(start.back());
    value.reserve(start.back());
    for (const unsigned int i : row)
      for (std::size_t k = stiffness.start[i]; k < stiffness.start[i + 1]; ++k)
      {
        column.push_back(stiffness.column[k]);
        value.push_back(stiffness.value[k]);
      }
  }

  void RockOperator::add_block(const std::vector<NodalCell> &cells, const std::vector<unsigned int> &part,
                               const std::vector<Vector3> &points, Numbering &numbering)
  {
    const auto               &kind = numbering.kind;
    std::vector<unsigned int> nodes;
    for (const unsigned int k : part)
      nodes.insert(nodes.end(), cells[k].nodes.begin(), cells[k].nodes.end());
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    if (4 * nodes.size() > 65536) // NodalPacks::corner has 16 bits; cells of a mesh share their nodes
      throw ComputationError(
          "The rock elements at " + Voussoir::place(points[nodes[0]]) + " do not share their nodes: " +
          std::to_string(nodes.size()) + " nodes of " + std::to_string(part.size()) +
          " elements. Merge coincident nodes in the mesh (gmsh: Coherence). If the mesh is intended, set the "
          "environment variable VOUSSOIR_KERNEL to matrix (slower).");
    std::stable_sort(nodes.begin(), nodes.end(),
                     [&](const unsigned int i, const unsigned int j) { return kind[i] < kind[j]; });
    const auto count = [&](const Numbering::Kind wanted) -> unsigned int
    {
      return std::count_if(nodes.begin(), nodes.end(),
                           [&](const unsigned int i) { return kind[i] == wanted; });
    };
    Block block;
    block.first_node = node.size();
    block.n_own = count(Numbering::own);
    block.n_shared = count(Numbering::shared);
    block.n_nodes = nodes.size();
    block.first_shared = shared_force.size() / 3;
    block.first_pack = lame_of.size();
    for (unsigned int i = 0; i < nodes.size(); ++i)
    {
      numbering.local[nodes[i]] = i;
      node.push_back(nodes[i]);
      place.push_back(points[nodes[i]]);
    }
    for (std::size_t k = 0; k < part.size(); k += n_lanes)
    {
      std::vector<const NodalCell *> pack;
      for (std::size_t i = k; i < std::min<std::size_t>(k + n_lanes, part.size()); ++i)
        pack.push_back(&cells[part[i]]);
      add_pack(pack, numbering);
    }
    block.n_packs = lame_of.size() - block.first_pack;
    shared_force.resize(shared_force.size() + 3 * std::size_t(block.n_shared));
    most_nodes = std::max(most_nodes, block.n_nodes);
    blocks.push_back(block);
  }

  void RockOperator::add_pack(const std::vector<const NodalCell *> &cells, Numbering &numbering)
  {
    std::array<double, 2 * n_lanes> constants{};
    for (unsigned int lane = 0; lane < cells.size(); ++lane)
    {
      constants[lane] = cells[lane]->lambda;
      constants[n_lanes + lane] = cells[lane]->mu;
    }
    for (unsigned int v = 0; v < 8; ++v)
      for (unsigned int lane = 0; lane < n_lanes; ++lane)
      {
        const NodalCell &cell = *cells[std::min<std::size_t>(lane, cells.size() - 1)];
        corner.push_back(4 * numbering.local[cell.nodes[v]]);
      }
    const auto [set, is_new] = numbering.lame.try_emplace(constants, lame.size());
    if (is_new)
      lame.insert(lame.end(), constants.begin(), constants.end());
    lame_of.push_back(set->second);
  }

  void RockOperator::find_shared_nodes(const RockSplit &split, Numbering &numbering)
  {
    auto &places = numbering.place;
    for (const Block &block : blocks)
      for (unsigned int i = 0; i < block.n_shared; ++i)
        places[{node[block.first_node + block.n_own + i], block.number}] = block.first_shared + i;
    if (!split.is_trivial())
    {
      unsigned int next = shared_force.size() / 3;
      for (const auto &[i, b] : numbering.in_block)
        if (numbering.kind[i] == Numbering::shared && split.is_stepped(i) &&
            numbering.rank[b] != Ranks::rank())
          places[{i, b}] = next++;
      shared_force.resize(3 * std::size_t(next));
    }
    for (const auto &[of, at] : places) // by node, then by block
    {
      const unsigned int i = of.first;
      if (shared_node.empty() || shared_node.back() != i)
      {
        shared_node.push_back(i);
        shared_start.push_back(shared_place.size());
      }
      shared_place.push_back(at);
    }
    shared_start.push_back(shared_place.size());
  }

  void RockOperator::multiply_row(const std::size_t r, const double *x, double *y) const
  {
    double y0 = 0., y1 = 0., y2 = 0.;
    for (std::size_t k = start[r]; k < start[r + 1]; ++k)
    {
      const double *a = value[k].data(), *p = x + 3 * std::size_t(column[k]);
      y0 += a[0] * p[0] + a[1] * p[1] + a[2] * p[2];
      y1 += a[3] * p[0] + a[4] * p[1] + a[5] * p[2];
      y2 += a[6] * p[0] + a[7] * p[1] + a[8] * p[2];
    }
    double *to = y + 3 * std::size_t(row[r]);
    to[0] = y0, to[1] = y1, to[2] = y2;
  }

  void RockOperator::multiply_block(const Block &block, const double *x, double *y, CacheLine *scratch) const
  {
    const unsigned int *nodes = node.data() + block.first_node;
    const Vector3      *places = place.data() + block.first_node;
    double             *force = scratch[most_nodes].value,
           *shared = shared_force.data() + 3 * std::size_t(block.first_shared);
    constexpr unsigned int ahead = 24; // distance of the prefetch [nodes]
    for (unsigned int i = 0; i < block.n_nodes; ++i)
    {
      __builtin_prefetch(x + 3 * std::size_t(nodes[std::min(i + ahead, block.n_nodes - 1)]));
      const double  *u = x + 3 * std::size_t(nodes[i]);
      const Vector3 &p = places[i];
      scratch[i] = {{p[0], p[1], p[2], 0., u[0], u[1], u[2], 0.}};
    }
    std::fill_n(force, 4 * std::size_t(block.n_nodes), 0.);
    kernel({block.n_packs, corner.data() + 8 * n_lanes * std::size_t(block.first_pack), lame.data(),
            lame_of.data() + block.first_pack, scratch[0].value, force});
    const auto give = [](const double *f, double *to) { to[0] = f[0], to[1] = f[1], to[2] = f[2]; };
    for (unsigned int i = 0; i < block.n_own; ++i)
      give(force + 4 * i, y + 3 * std::size_t(nodes[i]));
    for (unsigned int i = 0; i < block.n_shared; ++i)
      give(force + 4 * (block.n_own + i), shared + 3 * i);
  }

  void RockOperator::sum_shared(const std::size_t i, double *y) const
  {
    double sum[3] = {0., 0., 0.}, *to = y + 3 * std::size_t(shared_node[i]);
    for (unsigned int k = shared_start[i]; k < shared_start[i + 1]; ++k)
    {
      const double *f = shared_force.data() + 3 * std::size_t(shared_place[k]);
      sum[0] += f[0], sum[1] += f[1], sum[2] += f[2];
    }
    to[0] = sum[0], to[1] = sum[1], to[2] = sum[2];
  }

  void RockOperator::multiply(const double *x, double *y) const
  {
    std::vector<Ranks::Message> messages;
    begin_product(x, y, messages);
    Ranks::exchange(messages);
    end_product(y);
  }

  void RockOperator::begin_product(const double *x, double *y, std::vector<Ranks::Message> &messages) const
  {
    const int n_rows = row.size(), n_blocks = blocks.size(), n_shared = shared_node.size();
    int       n_threads = 1;
#ifdef _OPENMP
    n_threads = omp_get_max_threads();
#endif
    const std::unique_ptr<CacheLine[]> scratch(new CacheLine[n_threads * scratch_size()]);
#pragma omp parallel num_threads(n_threads)
    {
      int thread = 0;
#ifdef _OPENMP
      thread = omp_get_thread_num();
#endif
#pragma omp for schedule(static) nowait
      for (int r = 0; r < n_rows; ++r)
        multiply_row(r, x, y);
#pragma omp for schedule(dynamic)
      for (int b = 0; b < n_blocks; ++b)
        multiply_block(blocks[b], x, y, scratch.get() + thread * scratch_size());
      if (partners.empty())
      {
#pragma omp for schedule(static)
        for (int i = 0; i < n_shared; ++i)
          sum_shared(i, y);
      }
    }
    pack_forces(y, messages);
  }

  void RockOperator::end_product(double *y) const
  {
    if (partners.empty())
      return;
    unpack_forces(y);
    const int n_shared = shared_node.size();
#pragma omp parallel for schedule(static)
    for (int i = 0; i < n_shared; ++i)
      sum_shared(i, y);
  }

  std::size_t RockOperator::memory() const
  {
    const auto bytes = [](const auto &array) { return array.capacity() * sizeof(array[0]); };
    return bytes(blocks) + bytes(node) + bytes(place) + bytes(corner) + bytes(lame) + bytes(lame_of) +
           bytes(shared_force) + bytes(shared_node) + bytes(shared_start) + bytes(shared_place) + bytes(row) +
           bytes(start) + bytes(column) + bytes(value);
  }
} // namespace Voussoir
