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
  class FootElimination;

  /** The symmetric operator W of the joints, gap = W force + b, in dense blocks by group of pairs (a joint).
   *  Two groups are coupled where one body touches both, so along an arch W is block tridiagonal.
   *
   *  On a support that makes steps of its own the operator is that less what the feet take off, W - B H^-1
   * B^T, which couples all groups. Exact products take it so; in single precision, where products are for
   * Newton's steps and the sweeps, the blocks are those of the whole operator, but of the coupled groups
   * only.
   *
   *  With several ranks each holds the blocks of its groups' rows, those of their neighbours' columns
   * included, and makes these rows of the products, which all get. */
  class InterfaceOperator : public ContactOperator
  {
  public:
    using Floats = std::vector<float>;

    /** @p n_pairs: pairs in each group; @p share: of the groups. */
    explicit InterfaceOperator(const std::vector<unsigned int> &n_pairs, Shares share = Shares());

    /** Are rows or columns of this block mine? */
    bool          holds(const unsigned int j, const unsigned int k) const { return is_mine(j) || is_mine(k); }
    bool          is_mine(const unsigned int group) const { return share.is_mine(group); }
    const Shares &shares() const { return share; }

    /** All ranks get the rows that each has made of its groups. */
    template <class Vector> void gather(Vector &x) const
    {
      if (!share.are_trivial())
        Ranks::gather(x.data(), share.parts(offset));
    }

    /** The block of rows of group @p j and columns of group @p k >= j, column by column; made on first use.
     * Empty if it is not held here. */
    std::vector<double>       &block(unsigned int j, unsigned int k);
    const std::vector<double> &block(unsigned int j, unsigned int k) const { return blocks.at({j, k}); }

    /** The block of groups @p j <= @p k, or nullptr where they are not coupled; empty if not held here. */
    const std::vector<double> *find_block(unsigned int j, unsigned int k) const
    {
      const auto found = blocks.find({j, k});
      return found == blocks.end() ? nullptr : &found->second;
    }

    /** y = W x. */
    void multiply(const Unknowns &x, Unknowns &y) const override;

    Matrix3 diagonal(unsigned int pair) const override;

    bool is_in_blocks() const override { return !eliminated; }

    /** The pairs of a group are visited three times at once. In single precision: @p gap is off by round-off
     * of that size. */
    void sweep(const PairSolver &solve_pair, Unknowns &force, Unknowns &gap) const override;

    void gather_pairs(Unknowns &values, const std::vector<std::size_t> &begin) const override;

    std::unique_ptr<ContactJacobian> make_jacobian() const override;

    /** One block Gauss-Seidel pass in single precision: @p own(g) for each group g, those of one colour (not
     * coupled) by all threads, by the rank whose group it is. Before it, W x of the groups that have been
     * visited is added to those rows of
     * @p Wx; it writes those of @p x. Afterwards @p Wx has the couplings' part of W x, besides what @p own
     * has added in its rows. finish() must have been called. */
    template <class Own> void gauss_seidel(const Own &own, Floats &x, Floats &Wx) const;

    unsigned int n_pairs() const override { return n() / 3; }

    unsigned int n_groups() const { return static_cast<unsigned int>(offset.size() - 1); }
    unsigned int n() const { return offset.back(); } ///< unknowns: three per pair
    unsigned int begin(const unsigned int group) const { return offset[group]; }
    unsigned int size(const unsigned int group) const { return offset[group + 1] - offset[group]; }
    const std::vector<unsigned int> &neighbours(const unsigned int group) const { return coupled[group]; }
    double                           memory() const; ///< [bytes]

    /** A group's own block of the operator, by column; with feet that are eliminated in single precision. */
    std::vector<double> own_block(unsigned int group) const;

    /** Make the copy in single precision, and choose the colours, once all blocks are filled in. @p feet:
     * what is to be taken off, or null. */
    void                      finish(std::shared_ptr<const FootElimination> feet = nullptr);
    const std::vector<float> &single_block(unsigned int j, unsigned int k) const { return single.at({j, k}); }

    /** y += W_jk x in single precision, also for j > k. */
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
    std::map<std::pair<unsigned int, unsigned int>, std::vector<float>>  single; ///< less the feet's part
    std::shared_ptr<const FootElimination>                               eliminated;
    std::vector<Matrix3>                                                 diagonals; ///< of pairs
    std::vector<unsigned int>                 colour; ///< of the groups; coupled ones have different ones
    std::vector<std::vector<unsigned int>>    groups_of_colour;
    std::vector<std::vector<Ranks::Transfer>> to_neighbours; ///< of the rows of each colour
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
