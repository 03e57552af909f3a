// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_split_h
#define voussoir_rock_split_h

#include <voussoir/base/ranks.h>

#include <utility>
#include <vector>

namespace Voussoir
{
  /** Which rank steps which nodes of a region. Each owns a range of numbers, in whole chunks, the units in
   * which energies are added up; it steps these, and all others that its cells and its boundary lines ask
   * for, as their owners do and to the same last bit: so no motions are exchanged, but forces of cells only
   * (RockOperator). */
  class RockSplit
  {
  public:
    static constexpr unsigned int per_chunk = 256; ///< nodes

    RockSplit() = default; ///< all by this rank
    explicit RockSplit(unsigned int n_nodes) : RockSplit(std::vector<double>(n_nodes, 1.)) {}
    /** All ranks get about the same sum of the @p work of the nodes. */
    explicit RockSplit(const std::vector<double> &work);

    bool         is_trivial() const { return steps.empty(); }
    unsigned int owner(unsigned int node) const;
    bool         is_stepped(const unsigned int node) const { return steps[Ranks::rank()][node]; }
    bool is_stepped(const unsigned int node, const unsigned int rank) const { return steps[rank][node]; }

    /** Of this rank. */
    const std::vector<bool> &stepped() const { return steps[Ranks::rank()]; }

    void step_everywhere(const std::vector<unsigned int> &nodes);
    void step(const std::vector<unsigned int> &nodes, unsigned int rank);

    /** Who steps the first node of a line, on the boundary, steps all of it; also what comes later, by
     * follow_lines(). */
    void set_lines(std::vector<std::vector<unsigned int>> nodes) { lines = std::move(nodes); }
    void follow_lines();

    /** Ranges of nodes that this rank steps, within chunks. @p n_nodes: of the region. */
    std::vector<std::pair<int, int>> pieces(int n_nodes) const;

    /** All ranks get the own nodes' values, @p n of each node. */
    void gather(std::vector<double> &data, unsigned int n) const;

    /** The same for values of chunks. */
    void gather_chunks(std::vector<double> &data, unsigned int n) const;

    /** All ranks get from the owner of its @p node each of the items, of @p n numbers. */
    void collect(std::vector<double> &data, unsigned int n, const std::vector<unsigned int> &node) const;

  private:
    std::vector<std::size_t>               begin; ///< chunk of each rank
    std::size_t                            n_nodes = 0;
    std::vector<std::vector<unsigned int>> lines; ///< their nodes
    std::vector<std::vector<bool>>         steps; ///< of each rank, of each node
  };
} // namespace Voussoir

#endif
