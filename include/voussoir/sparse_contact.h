#ifndef voussoir_sparse_contact_h
#define voussoir_sparse_contact_h

#include <voussoir/contact_operator.h>
#include <voussoir/interface_operator.h>

namespace Voussoir
{
  /** Any W, in 3x3 blocks, symmetric or not, of any rank: the operator of problems whose structure is not
   *  known. Its Newton systems are solved directly, dense or sparse. */
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

  /** Groups of pairs that are coupled to the same pairs, such as those of one joint of an arch: a permutation
   *  that makes each group contiguous, and their sizes. */
  struct PairGroups
  {
    std::vector<unsigned int> order; ///< new pair -> old pair
    std::vector<unsigned int> size;  ///< of each group [pairs]
  };
  PairGroups find_groups(const BlockSparseMatrix &W);

  /** Is W equal to its transpose, to round-off? */
  bool is_symmetric(const BlockSparseMatrix &W);

  /** The operator as one sparse matrix, joint after joint. */
  BlockSparseMatrix sparse_matrix(const InterfaceOperator &W);

  /** The same operator in dense blocks by group; @p W symmetric. */
  InterfaceOperator make_interface_operator(const BlockSparseMatrix &W, const PairGroups &groups);
} // namespace Voussoir

#endif
