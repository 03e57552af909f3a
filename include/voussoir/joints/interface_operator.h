// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_interface_operator_h
#define voussoir_interface_operator_h

#include <voussoir/base/parallel.h>
#include <voussoir/base/ranks.h>
#include <voussoir/contact/contact_operator.h>
#include <voussoir/joints/compact_matrix.h>

#include <map>
#include <memory>
#include <utility>

namespace Voussoir
{
  class BaseElimination;

  /** Symmetric operator W of the contact problem gap = W force + b [m/N], in dense blocks. A group is a set of
   * pairs, normally a joint. Block (j, k) has the rows of group j and the columns of group k. Two groups are
   * coupled if they share a body. Along an arch W is block tridiagonal.
   *
   * On a compliant support the operator is W - B H^-1 B^T (BaseElimination), which couples all groups.
   * Products in double precision use the complete operator. Products in single precision, for Newton steps
   * and Gauss-Seidel iterations, use its blocks of coupled groups only.
   *
   * With several MPI processes each process stores the blocks in the rows and columns of its groups. It
   * computes the rows of its groups in a product, and the result is gathered on all processes.
   *
   * Call block() and fill all blocks, then finish(), then the other functions. */
  class InterfaceOperator : public ContactOperator
  {
  public:
    using Floats = std::vector<float>; ///< three values per pair in single precision

    /** Creates an operator without blocks.
     * @param n_pairs number of pairs of each group
     * @param share distribution of the groups over the processes
     * @param clusters see #clusters */
    explicit InterfaceOperator(const std::vector<unsigned int> &n_pairs, Shares share = Shares(),
                               std::vector<std::vector<unsigned int>> clusters = {});

    /** Clusters of pairs that share nodes, for the preconditioner (Crossings). */
    const std::vector<std::vector<unsigned int>> clusters;

    /** Returns true if this process stores block (@p j, @p k): it owns group j or group k. */
    bool holds(const unsigned int j, const unsigned int k) const { return is_mine(j) || is_mine(k); }

    /** Returns true if this process owns the group. */
    bool is_mine(const unsigned int group) const { return share.is_mine(group); }

    /** Returns the distribution of the groups over the processes. */
    const Shares &shares() const { return share; }

    /** Gathers a vector with three values per pair on all processes. Before, each process has the values of
     * its groups. */
    template <class Vector> void gather(Vector &x) const
    {
      if (!share.are_trivial())
        Ranks::gather(x.data(), share.parts(offset));
    }

    /** Returns block (@p j, @p k) for j <= k, by column [m/N]. The function creates a missing block, which
     * couples the groups. The block is empty if this process does not store it. */
    std::vector<double> &block(unsigned int j, unsigned int k);

    /** Returns block (@p j, @p k) for j <= k, by column [m/N], or nullptr if the groups are not coupled. The
     * block is empty if this process does not store it. */
    const std::vector<double> *find_block(unsigned int j, unsigned int k) const
    {
      const auto found = blocks.find({j, k});
      return found == blocks.end() ? nullptr : &found->second;
    }

    /** Computes @p y = W @p x with the complete operator, in double precision. */
    void multiply(const Unknowns &x, Unknowns &y) const override;

    /** Returns the 3x3 diagonal block of a pair [m/N]. Call it after finish(). */
    Matrix3 diagonal(unsigned int pair) const override;

    /** Returns true if the blocks contain the complete operator. */
    bool is_in_blocks() const override { return !eliminated; }

    /** Performs one Gauss-Seidel iteration over all groups; within a group, three iterations over its pairs.
     * The resulting @p gap has a relative round-off error of 1e-7, or about 3e-6 with compact couplings. */
    void sweep(const PairSolver &solve_pair, Unknowns &force, Unknowns &gap) const override;

    void gather_pairs(Unknowns &values, const std::vector<std::size_t> &begin) const override;

    std::unique_ptr<ContactJacobian> make_jacobian() const override;

    /** Performs one block Gauss-Seidel iteration in single precision. Call it after finish().
     * @param own called as own(g) for each group g by the process that owns the group. Groups of one colour
     * are not coupled and run in parallel. Before the call, the products of W with the groups already visited
     * are added to the rows of g in @p Wx. The call computes the rows of g in @p x. It may
     * add the product with the diagonal block to the rows of g in @p Wx.
     * @param x unknowns, three values per pair
     * @param Wx receives W x, three values per pair, without the diagonal blocks if own() does not add them */
    template <class Own> void gauss_seidel(const Own &own, Floats &x, Floats &Wx) const;

    /** Returns the number of pairs of all groups. */
    unsigned int n_pairs() const override { return n() / 3; }

    /** Returns the number of groups. */
    unsigned int n_groups() const { return static_cast<unsigned int>(offset.size() - 1); }

    /** Returns the number of unknowns, three per pair. */
    unsigned int n() const { return offset.back(); }

    /** Returns the first unknown of a group. */
    unsigned int begin(const unsigned int group) const { return offset[group]; }

    /** Returns the number of unknowns of a group. */
    unsigned int size(const unsigned int group) const { return offset[group + 1] - offset[group]; }

    /** Returns the groups that are coupled with a group, ascending. */
    const std::vector<unsigned int> &neighbours(const unsigned int group) const { return coupled[group]; }

    /** Returns the memory consumption [bytes]. */
    double memory() const;

    /** Returns the diagonal block of a group, by column [m/N]. If base nodes are eliminated, their part is
     * subtracted, and the block is rounded to single precision. */
    std::vector<double> own_block(unsigned int group) const;

    /** Copies the blocks to single precision and assigns the colours of the groups. Call it after all blocks
     * are filled.
     * @param base eliminated base nodes, whose part is subtracted; nullptr: none
     * @param compact the couplings of groups have two instead of four bytes per entry (CompactMatrix). Newton's
     * method then takes 1 % more steps in an earthquake, and more where joints cross and in static states. */
    void finish(std::shared_ptr<const BaseElimination> base = nullptr, bool compact = false);

    /** Returns the diagonal block of a group in single precision, by column [m/N]. */
    const Floats &single_block(unsigned int group) const { return single[group]; }

    /** Returns block (@p j, @p k) for j < k in single precision [m/N]. */
    const CompactMatrix &coupling(unsigned int j, unsigned int k) const { return couplings.at({j, k}); }

    /** Computes @p y += W_jk @p x in single precision, also for j > k. @p x: unknowns of group k; @p y: rows
     * of group j. */
    void add_single(unsigned int j, unsigned int k, const float *x, float *y) const;

  private:
    void    sweep_group(unsigned int j, const PairSolver &solve_pair, double *force, const double *gap,
                        float *moved, float *change) const;
    Matrix3 diagonal_of_blocks(unsigned int pair) const;
    void    find_diagonals();
    void    find_colours();

    Shares                                                               share;
    std::vector<unsigned int>                                            offset;
    std::vector<std::vector<unsigned int>>                               coupled;
    std::map<std::pair<unsigned int, unsigned int>, std::vector<double>> blocks;
    // In single precision; the part of eliminated base nodes is subtracted.
    std::vector<Floats>                                            single;    ///< diagonal blocks
    std::map<std::pair<unsigned int, unsigned int>, CompactMatrix> couplings; ///< other blocks
    std::shared_ptr<const BaseElimination>                         eliminated;
    std::vector<Matrix3>                      diagonals; ///< diagonal blocks of the pairs
    std::vector<unsigned int>                 colour;    ///< per group; coupled groups have different colours
    std::vector<std::vector<unsigned int>>    groups_of_colour;
    std::vector<std::vector<Ranks::Transfer>> to_neighbours; ///< transfers of the rows of each colour
  };

  template <class Own> void InterfaceOperator::gauss_seidel(const Own &own, Floats &x, Floats &Wx) const
  {
    std::vector<std::vector<Floats>> back(n_groups()); // W_kg x_g for the earlier neighbours k of g
    const auto                       for_earlier = [this](const unsigned int g, const auto &action)
    {
      for (const unsigned int k : coupled[g])
        if (colour[k] < colour[g] && size(k) > 0)
          action(k);
    };
    const auto give_back = [&](const unsigned int g)
    {
      for_earlier(g,
                  [&](const unsigned int k)
                  {
                    if (!is_mine(k))
                      return;
                    back[g].emplace_back(size(k), 0.f);
                    add_single(k, g, x.data() + begin(g), back[g].back().data());
                  });
    };
    for (unsigned int c = 0; c < groups_of_colour.size(); ++c)
    {
      const auto &groups = groups_of_colour[c];
      for_each_parallel(groups.size(),
                        [&](const int i)
                        {
                          const unsigned int g = groups[i];
                          if (size(g) == 0 || !is_mine(g))
                            return;
                          for_earlier(g, [&](const unsigned int k)
                                      { add_single(g, k, x.data() + begin(k), Wx.data() + begin(g)); });
                          own(g);
                          give_back(g); // the coupling is in the cache
                        });
      Ranks::exchange(x.data(), to_neighbours[c]);
      for (const auto &given : to_neighbours[c])
        if (given.to == Ranks::rank())
          give_back(given.item);
    }
    for (unsigned int g = 0; g < n_groups(); ++g)
    {
      auto product = back[g].begin();
      for_earlier(g,
                  [&](const unsigned int k)
                  {
                    if (product == back[g].end() || !is_mine(k))
                      return;
                    for (unsigned int j = 0; j < size(k); ++j)
                      Wx[begin(k) + j] += (*product)[j];
                    ++product;
                  });
    }
    if (!share.are_trivial())
      Ranks::gather(x.data(), Wx.data(), share.parts(offset));
  }
} // namespace Voussoir

#endif
