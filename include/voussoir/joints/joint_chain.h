// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_chain_h
#define voussoir_joint_chain_h

#include <voussoir/joints/joint_factor.h>

namespace Voussoir
{
  /** Block LU decomposition of J = d_force + d_gap W in single precision, for joints that are coupled to
   * their neighbours only, as along an arch: S_g = J_gg - J_g,g-1 S_g-1^-1 J_g-1,g from one end
   * to the other. */
  class JointChain
  {
  public:
    explicit JointChain(const InterfaceOperator &W); ///< @p W must outlive the object

    /** Computes the decomposition for the given equations, one per pair. */
    void factorise(const std::vector<PairEquations> &equations);

    /** Computes z = J^-1 v in the rows that are not trivial. Other rows of @p z do not change. */
    void solve(const std::vector<float> &v, std::vector<float> &z) const;

  private:
    void give(unsigned int from, unsigned int to, std::vector<float> &values) const;
    void fill_coupling(unsigned int row_group, unsigned int column_group, std::vector<float> &block) const;

    const InterfaceOperator        &W;
    std::vector<JointFactor>        factors; ///< factors of S_g
    std::vector<std::vector<float>> below;   ///< J_g,g-1
    std::vector<std::vector<float>> above;   ///< S_g-1^-1 J_g-1,g
  };
} // namespace Voussoir

#endif
