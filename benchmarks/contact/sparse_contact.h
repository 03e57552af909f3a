// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_sparse_contact_h
#define voussoir_sparse_contact_h

#include <voussoir/base/node_matrix.h>
#include <voussoir/contact/contact_operator.h>

namespace Voussoir
{
  /** Contact operator W given as a sparse matrix of 3x3 blocks. W may be nonsymmetric or singular. Newton's
   * linear systems are solved directly, with a dense or a sparse factorisation. */
  class SparseContactOperator : public ContactOperator
  {
  public:
    explicit SparseContactOperator(BlockSparseMatrix W) : W(std::move(W)) {}

    unsigned int n_pairs() const override { return W.n_rows(); }
    Matrix3      diagonal(unsigned int pair) const override;
    void         multiply(const Unknowns &x, Unknowns &y) const override;
    void         sweep(const PairSolver &solve_pair, Unknowns &force, Unknowns &gap) const override;
    std::unique_ptr<ContactJacobian> make_jacobian() const override;

    const BlockSparseMatrix &matrix() const { return W; }

  private:
    const BlockSparseMatrix W;
  };

  /** Returns whether W is symmetric up to round-off. */
  bool is_symmetric(const BlockSparseMatrix &W);
} // namespace Voussoir

#endif
