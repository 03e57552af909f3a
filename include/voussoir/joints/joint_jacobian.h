// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_jacobian_h
#define voussoir_joint_jacobian_h

#include <voussoir/joints/joint_chain.h>

namespace Voussoir
{
  /** The linear systems of Newton's method for the joints: J = d_force + d_gap W.
   *
   *  GMRES, preconditioned by P = D + L: D are the joints' own blocks, dense LU; L are the couplings to
   *  joints of earlier colour (neighbouring joints have different colours), so that P is block Gauss-Seidel
   *  and joints of one colour run in parallel. With J = D + L + U a product costs nothing beyond the
   *  preconditioner, J P^-1 v = v + U P^-1 v, since each coupling is used for L and U while it is in the
   *  cache. Joints in which no pair changed its state keep their factors; the small difference is added to
   * the product. All this in single precision, half the memory traffic: it only makes Newton's steps, whose
   *  residuals are evaluated in double precision.
   *
   *  Where the joints depend on each other so much that this takes many iterations (statics), and each is
   *  coupled to its neighbours only, the preconditioner is the block LU decomposition of the whole chain. */
  class JointJacobian : public ContactJacobian
  {
  public:
    explicit JointJacobian(const InterfaceOperator &W); ///< @p W must outlive this

    unsigned int update(const std::vector<PairEquations> &equations) override;
    unsigned int solve(double tolerance, Unknowns &step, Unknowns &d_gap) override;

  private:
    using Floats = std::vector<float>;
    struct Factor : JointFactor
    {
      bool exact = false; ///< is it that of the present equations?
    };

    const PairEquations *present(unsigned int group) const { return equations->data() + W.begin(group) / 3; }
    const Floats        &coupling(unsigned int j, unsigned int k) const
    {
      return W.single_block(std::min(j, k), std::max(j, k));
    }
    bool         needs_factor(unsigned int group) const;
    void         apply_factor(unsigned int group, float *x) const;
    void         multiply_by_d_gap(unsigned int group, float factor, const float *x, float *y) const;
    void         multiply_J(const Floats &z, Floats &w) const;
    void         multiply_W(const Floats &x, Floats &y) const;
    void         multiply_W_sparse(const Unknowns &x, Floats &y) const;
    void         apply(const Floats &v, Floats &z, Floats &w) const;
    void         correct_stale(unsigned int group, const Floats &z, Floats &w) const;
    unsigned int gmres(const Unknowns &r, double target, Unknowns &step) const;

    const InterfaceOperator                           &W;
    std::vector<std::pair<unsigned int, unsigned int>> keys; ///< of the blocks
    const std::vector<PairEquations>                  *equations = nullptr;
    std::vector<Factor>                                factors;
    std::vector<std::vector<unsigned int>>             groups_of_colour;
    std::vector<unsigned int>                          colour;
    bool                        is_chain = true;   ///< is each joint coupled to its neighbours only?
    bool                        use_chain = false; ///< from the next equations on
    std::unique_ptr<JointChain> chain;             ///< instead of the factors, once GMRES was slow
  };
} // namespace Voussoir

#endif
