// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_jacobian_h
#define voussoir_joint_jacobian_h

#include <voussoir/joints/crossings.h>
#include <voussoir/joints/joint_block.h>
#include <voussoir/joints/joint_chain.h>

namespace Voussoir
{
  /** Linear systems of Newton's method for the joints: J = d_force + d_gap W.
   *
   * GMRES in single precision, preconditioned by P = D + L. D has the diagonal blocks of the joints
   * (JointBlock). L has the couplings to joints of earlier colour; neighbouring joints have different colours. P is a
   * block Gauss-Seidel iteration, in which joints of one colour run in parallel. Where joints cross, Crossings corrects
   * the result.
   *
   * The preconditioner computes z = P^-1 v together with W z: JointBlock supplies W_jj z_j, and each coupling
   * is used in both directions while it is in the cache. A product J z = d_force z + d_gap W z therefore
   * needs no further access to W. The change of the gap is known at the end.
   *
   * Single precision halves the memory traffic. The residuals of Newton steps are computed in double precision.
   *
   * If GMRES takes many iterations, or if this is expected (statics), the block LU decomposition of the whole chain
   * (JointChain) replaces the preconditioner. This requires that each joint is coupled to its neighbours only. */
  class JointJacobian : public ContactJacobian
  {
  public:
    explicit JointJacobian(const InterfaceOperator &W); ///< @p W must outlive the object

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
    std::vector<std::pair<unsigned int, unsigned int>> keys; ///< indices of the blocks
    const std::vector<PairEquations>                  *equations = nullptr;
    std::vector<JointBlock>                            joints;
    Crossings                                          crossings;
    bool                        is_chain = true;       ///< each joint is coupled to its neighbours only
    bool                        expects_chain = false; ///< JointChain in all problems
    bool                        use_chain = false; ///< JointChain from the next equations of this problem on
    bool                        has_chain = false; ///< JointChain for the current equations
    std::unique_ptr<JointChain> chain;             ///< replaces the blocks of the joints if GMRES is slow
  };
} // namespace Voussoir

#endif
