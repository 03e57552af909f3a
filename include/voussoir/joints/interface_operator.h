// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_interface_operator_h
#define voussoir_interface_operator_h

#include <voussoir/contact/contact_operator.h>

#include <map>
#include <utility>

namespace Voussoir
{
  /** The symmetric operator W of the joints, gap = W force + b, in dense blocks by group of pairs (a joint).
   *  Two groups are coupled where one body touches both, so along an arch W is block tridiagonal. */
  class InterfaceOperator : public ContactOperator
  {
  public:
    /** @p n_pairs: pairs in each group. */
    explicit InterfaceOperator(const std::vector<unsigned int> &n_pairs);

    /** The block of rows of group @p j and columns of group @p k >= j, column by column; made on first use.
     */
    std::vector<double>       &block(unsigned int j, unsigned int k);
    const std::vector<double> &block(unsigned int j, unsigned int k) const { return blocks.at({j, k}); }

    /** The block of groups @p j <= @p k, or nullptr where they are not coupled. */
    const std::vector<double> *find_block(unsigned int j, unsigned int k) const
    {
      const auto found = blocks.find({j, k});
      return found == blocks.end() ? nullptr : &found->second;
    }

    /** y = W x. */
    void multiply(const Unknowns &x, Unknowns &y) const override;

    /** y_j += factor * W_jk x_k for one pair of groups. */
    void add_coupling(unsigned int j, unsigned int k, double factor, const double *x, double *y) const;

    Matrix3 diagonal(unsigned int pair) const override;

    /** Groups of one colour run in parallel. In single precision: @p gap is off by round-off of that size. */
    void sweep(const PairSolver &solve_pair, Unknowns &force, Unknowns &gap) const override;

    std::unique_ptr<ContactJacobian> make_jacobian() const override;

    /** The groups by colour: coupled groups have different ones. Once all blocks are there. */
    std::vector<std::vector<unsigned int>> colours() const;

    unsigned int n_pairs() const override { return n() / 3; }

    unsigned int n_groups() const { return static_cast<unsigned int>(offset.size() - 1); }
    unsigned int n() const { return offset.back(); } ///< unknowns: three per pair
    unsigned int begin(const unsigned int group) const { return offset[group]; }
    unsigned int size(const unsigned int group) const { return offset[group + 1] - offset[group]; }
    const std::vector<unsigned int> &neighbours(const unsigned int group) const { return coupled[group]; }
    double                           memory() const; ///< [bytes]

    /** Make the copy in single precision, once all blocks are filled in. */
    void                      finish();
    const std::vector<float> &single_block(unsigned int j, unsigned int k) const { return single.at({j, k}); }

    /** y += W_jk x in single precision, also for j > k. */
    void add_single(unsigned int j, unsigned int k, const float *x, float *y) const;

  private:
    void sweep_group(unsigned int j, const PairSolver &solve_pair, Unknowns &force, Unknowns &gap,
                     std::vector<float> &change) const;

    std::vector<unsigned int>                                            offset;
    std::vector<std::vector<unsigned int>>                               coupled;
    std::map<std::pair<unsigned int, unsigned int>, std::vector<double>> blocks;
    std::map<std::pair<unsigned int, unsigned int>, std::vector<float>>  single; ///< the same
  };
} // namespace Voussoir

#endif
