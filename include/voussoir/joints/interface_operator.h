// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_interface_operator_h
#define voussoir_interface_operator_h

#include <voussoir/base/parallel.h>
#include <voussoir/base/ranks.h>
#include <voussoir/contact/contact_operator.h>

#include <map>
#include <memory>
#include <utility>

namespace Voussoir
{
  class BaseElimination;

  /** Symmetric operator W of the joints, gap = W force + b [m/N], in dense blocks by group of pairs (a
   * joint). Two groups are coupled if they share a body. Along an arch W is block tridiagonal.
   *
   * On a subcycled foundation the operator is W - B H^-1 B^T (BaseElimination), which couples all groups.
   * Products in double precision use the complete operator. Products in single precision, for Newton steps
   * and Gauss-Seidel iterations, use its blocks of coupled groups only.
   *
   * With several MPI processes each process holds the blocks of the rows of its groups, including the columns
   * of neighbours. It computes these rows of a product; the result is gathered on all processes. */
  class InterfaceOperator : public ContactOperator
  {
  public:
    using Floats = std::vector<float>;

    /** Creates an operator without entries. @p n_pairs: number of pairs of each group; @p share: distribution
     * of the groups. */
    explicit InterfaceOperator(const std::vector<unsigned int> &n_pairs, Shares share = Shares());

    /** Returns true if this process owns the rows or the columns of the block. */
    bool holds(const unsigned int j, const unsigned int k) const { return is_mine(j) || is_mine(k); }
    bool is_mine(const unsigned int group) const { return share.is_mine(group); } ///< group of this process
    const Shares &shares() const { return share; }                                ///< distribution of groups

    /** Gathers the rows that each process has computed on all processes. */
    template <class Vector> void gather(Vector &x) const
    {
      if (!share.are_trivial())
        Ranks::gather(x.data(), share.parts(offset));
    }

    /** Returns the block with the rows of group @p j and the columns of group @p k >= j, by column. Creates
     * it if necessary. Empty if this process does not hold it. */
    std::vector<double>       &block(unsigned int j, unsigned int k);
    const std::vector<double> &block(unsigned int j, unsigned int k) const { return blocks.at({j, k}); }

    /** Returns the block of the groups @p j <= @p k, or nullptr if they are not coupled. Empty if this
     * process does not hold it. */
    const std::vector<double> *find_block(unsigned int j, unsigned int k) const
    {
      const auto found = blocks.find({j, k});
      return found == blocks.end() ? nullptr : &found->second;
    }

    /** Computes y = W x with the complete operator. */
    void multiply(const Unknowns &x, Unknowns &y) const override;

    /** Returns the 3x3 diagonal block of a pair [m/N]. */
    Matrix3 diagonal(unsigned int pair) const override;

    /** Returns true if the blocks contain the complete operator. */
    bool is_in_blocks() const override { return !eliminated; }

    /** Performs one Gauss-Seidel iteration over all pairs. The pairs of a group are visited three times in
     * sequence. Blocks are in single precision, so @p gap has an error of the size of their round-off. */
    void sweep(const PairSolver &solve_pair, Unknowns &force, Unknowns &gap) const override;

    void gather_pairs(Unknowns &values, const std::vector<std::size_t> &begin) const override;

    std::unique_ptr<ContactJacobian> make_jacobian() const override;

    /** Performs one block Gauss-Seidel iteration in single precision. Call it after finish().
     * @param own called as own(g) for each group g by the process that owns it; groups of one colour are not
     * coupled and run in parallel. Before the call, W x of the groups already visited is added to the rows of
     * g in @p Wx. The call writes the rows of @p x.
     * @param x unknowns of all groups
     * @param Wx receives the coupling part of W x, in addition to what @p own adds to its rows */
    template <class Own> void gauss_seidel(const Own &own, Floats &x, Floats &Wx) const;

    unsigned int n_pairs() const override { return n() / 3; }

    unsigned int n_groups() const { return static_cast<unsigned int>(offset.size() - 1); }
    unsigned int n() const { return offset.back(); } ///< number of unknowns, three per pair
    unsigned int begin(const unsigned int group) const { return offset[group]; } ///< first unknown
    /** Returns the number of unknowns. */
    unsigned int size(const unsigned int group) const { return offset[group + 1] - offset[group]; }
    const std::vector<unsigned int> &neighbours(const unsigned int group) const { return coupled[group]; }
    double                           memory() const; ///< memory consumption [bytes]

    /** Returns the diagonal block of a group by column. If base nodes are eliminated, their part is
     * subtracted, and the block is rounded to single precision. */
    std::vector<double> own_block(unsigned int group) const;

    /** Copies the blocks to single precision and chooses the colours. Call it after all blocks are filled.
     * @p base: eliminated base nodes, whose part is subtracted, or nullptr. */
    void                      finish(std::shared_ptr<const BaseElimination> base = nullptr);
    const std::vector<float> &single_block(unsigned int j, unsigned int k) const { return single.at({j, k}); }

    /** Computes y += W_jk x in single precision, also for j > k. */
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
    std::map<std::pair<unsigned int, unsigned int>, std::vector<float>>
                                              single; ///< part of eliminated base nodes subtracted
    std::shared_ptr<const BaseElimination>    eliminated;
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
