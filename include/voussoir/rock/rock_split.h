// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_split_h
#define voussoir_rock_split_h

#include <voussoir/base/ranks.h>

#include <utility>
#include <vector>

namespace Voussoir
{
  /** Distribution of the nodes of a region over the MPI processes. Each process owns a range of nodes in
   * whole chunks. A chunk is the unit in which energies are added. A process also integrates the nodes of
   * other owners that its cells and boundary lines require; the results are bitwise identical to those of
   * the owners. Therefore only cell forces are exchanged (RockOperator), and no motions. */
  class RockSplit
  {
  public:
    static constexpr unsigned int per_chunk = 256; ///< nodes per chunk

    RockSplit() = default; ///< one process integrates all nodes
    explicit RockSplit(unsigned int n_nodes) : RockSplit(std::vector<double>(n_nodes, 1.)) {}
    /** Creates ranges of about equal work. @p work: computational work of each node, in any unit. */
    explicit RockSplit(const std::vector<double> &work);

    /** Returns true if one process integrates all nodes. */
    bool is_trivial() const { return steps.empty(); }
    /** Returns the process that owns @p node. */
    unsigned int owner(unsigned int node) const;
    /** Returns true if this process integrates @p node. */
    bool is_stepped(const unsigned int node) const { return steps[Ranks::rank()][node]; }
    /** Returns true if the process @p rank integrates @p node. */
    bool is_stepped(const unsigned int node, const unsigned int rank) const { return steps[rank][node]; }

    /** Returns for each node whether this process integrates it. */
    const std::vector<bool> &stepped() const { return steps[Ranks::rank()]; }

    /** Adds @p nodes to the nodes of all processes. */
    void step_everywhere(const std::vector<unsigned int> &nodes);
    /** Adds @p nodes to the nodes of the process @p rank. */
    void step(const std::vector<unsigned int> &nodes, unsigned int rank);

    /** Sets the boundary lines. A process that integrates the first node of a line integrates all nodes of
     * the line. Call follow_lines() after later additions. */
    void set_lines(std::vector<std::vector<unsigned int>> nodes) { lines = std::move(nodes); }
    /** Adds the nodes of all lines whose first node a process integrates. */
    void follow_lines();

    /** Returns the ranges of nodes that this process integrates; no range crosses a chunk. @p n_nodes: number
     * of nodes of the region. */
    std::vector<std::pair<int, int>> pieces(int n_nodes) const;

    /** Gathers @p data on all processes, with @p n values per node, from the owners of the nodes. */
    void gather(std::vector<double> &data, unsigned int n) const;

    /** Gathers @p data on all processes, with @p n values per chunk. */
    void gather_chunks(std::vector<double> &data, unsigned int n) const;

    /** Gathers items of @p n values on all processes. The owner of entry i of @p node supplies item i. */
    void gather(std::vector<double> &data, unsigned int n, const std::vector<unsigned int> &node) const;

  private:
    std::vector<std::size_t>               begin; ///< first chunk of each process
    std::size_t                            n_nodes = 0;
    std::vector<std::vector<unsigned int>> lines; ///< nodes of each boundary line
    std::vector<std::vector<bool>>         steps; ///< per process and node
  };
} // namespace Voussoir

#endif
