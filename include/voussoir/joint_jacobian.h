#ifndef voussoir_joint_jacobian_h
#define voussoir_joint_jacobian_h

#include <voussoir/interface_operator.h>

namespace Voussoir
{
  /** The linear systems of Newton's method for the joints: J = d_force + d_gap W.
   *
   *  GMRES, preconditioned by P = D + L: D are the joints' own blocks, dense LU; L are the couplings to
   * joints of earlier colour (neighbouring joints have different colours), so that P is block Gauss-Seidel
   * and joints of one colour run in parallel. With J = D + L + U a product costs little more than the
   * preconditioner: J P^-1 v = v + U P^-1 v. Joints in which no pair changed its state keep their factors;
   * the small difference is added to the product. All this in single precision, half the memory traffic: it
   * only makes Newton's steps, whose residuals are evaluated in double precision. */
  class JointJacobian : public ContactJacobian
  {
  public:
    explicit JointJacobian(const InterfaceOperator &W); ///< @p W must outlive this

    unsigned int update(const std::vector<PairEquations> &equations) override;
    unsigned int solve(double tolerance, Unknowns &step, Unknowns &d_gap) override;

  private:
    using Floats = std::vector<float>;
    using Block = std::array<float, 9>;
    struct Factor
    {
      std::vector<unsigned int>
                       active; ///< rows of the group that are not trivial (residual = force component)
      Floats           lu;
      std::vector<int> pivots;
      std::vector<PairEquations> equations;     ///< what it was made from
      bool                       exact = false; ///< is it that of the present equations?
    };

    bool         needs_factor(unsigned int group) const;
    void         factorise(unsigned int group);
    void         apply_factor(unsigned int group, float *x) const;
    void         multiply_block(unsigned int j, unsigned int k, const float *x, float *y) const;
    void         add_couplings(const Floats &z, Floats &v, unsigned int group, bool later) const;
    void         precondition(const Floats &v, Floats &z) const;
    void         multiply(const Floats &v, const Floats &z, Floats &w) const;
    void         multiply_W(const Unknowns &x, Unknowns &y) const;
    unsigned int gmres(const Unknowns &r, double target, Unknowns &step) const;

    const InterfaceOperator                                &W;
    std::map<std::pair<unsigned int, unsigned int>, Floats> blocks; ///< W in single precision
    const std::vector<PairEquations>                       *equations = nullptr;
    std::vector<Factor>                                     factors;
    std::vector<std::vector<unsigned int>>                  groups_of_colour;
    std::vector<unsigned int>                               colour;
  };
} // namespace Voussoir

#endif
