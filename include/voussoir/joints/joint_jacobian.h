// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_jacobian_h
#define voussoir_joint_jacobian_h

#include <voussoir/joints/joint_block.h>
#include <voussoir/joints/joint_chain.h>

namespace Voussoir
{
  /** The linear systems of Newton's method for the joints: J = d_force + d_gap W.
   *
   *  GMRES, preconditioned by P = D + L: D are the joints' own blocks (JointBlock); L are the couplings to
   *  joints of earlier colour (neighbouring joints have different colours), so that P is block Gauss-Seidel
   *  and joints of one colour run in parallel. W z comes with z = P^-1 v: W_jj z_j from the block, and each
   *  coupling is used in both directions while it is in the cache. So a product J z = d_force z + d_gap W z
   *  costs nothing beyond the preconditioner, is right for factors of older equations, too, and the change of
   *  the gap of the solution is known in the end. All this in single precision, half the memory traffic: it
   *  only makes Newton's steps, whose residuals are evaluated in double precision.
   *
   *  Where the joints depend on each other so much that this takes many iterations, or will (statics), and
   * each is coupled to its neighbours only, the preconditioner is the block LU decomposition of the whole
   * chain. */
  class JointJacobian : public ContactJacobian
  {
  public:
    explicit JointJacobian(const InterfaceOperator &W); ///< @p W must outlive this

    void         begin() override;
    void         expect_far_coupling() override { expects_chain = use_chain = is_chain; }
    unsigned int update(const std::vector<PairEquations> &equations) override;
    unsigned int solve(double tolerance, Unknowns &step, Unknowns &d_gap) override;

  private:
    using Floats = std::vector<float>;

    const PairEquations *present(unsigned int group) const { return equations->data() + W.begin(group) / 3; }
    void                 multiply_by_d_gap(unsigned int group, float factor, const float *x, float *y) const;
    void                 multiply_J(const Floats &z, const Floats &Wz, Floats &w) const;
    void                 multiply_W(const Floats &x, Floats &y) const;
    void                 multiply_W_sparse(const Unknowns &x, Floats &y) const;
    void                 precondition(const Floats &v, Floats &z, Floats &Wz) const;
    unsigned int         solve_blocks(double tolerance, Unknowns &step, Unknowns &d_gap);
    unsigned int         correct(double tolerance, Unknowns &step, Unknowns &d_gap) const;
    unsigned int         gmres(const Unknowns &r, double target, Unknowns &step, Unknowns &d_gap) const;

    const InterfaceOperator                           &W;
    std::vector<std::pair<unsigned int, unsigned int>> keys; ///< of the blocks
    const std::vector<PairEquations>                  *equations = nullptr;
    std::vector<JointBlock>                            joints;
    bool                        is_chain = true;       ///< is each joint coupled to its neighbours only?
    bool                        expects_chain = false; ///< in all problems
    bool                        use_chain = false;     ///< from the next equations of this problem on
    bool                        has_chain = false;     ///< in the present ones
    std::unique_ptr<JointChain> chain;                 ///< instead of the joints' blocks, once GMRES was slow
  };
} // namespace Voussoir

#endif
