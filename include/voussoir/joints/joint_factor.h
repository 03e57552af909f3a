// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_factor_h
#define voussoir_joint_factor_h

#include <voussoir/joints/interface_operator.h>

namespace Voussoir
{
  /** Returns true if the row gives a component of the force directly: it does not depend on the gap. */
  bool row_is_trivial(const PairEquations &equations, unsigned int component);

  /** Diagonal block of a joint in J = d_force + d_gap W, restricted to the rows and columns that are not
   * trivial, and its LU decomposition in single precision. */
  struct JointFactor
  {
    /** Finds the active rows of joint @p group. @p present: equations of its first pair, followed
     * by the others. */
    void find_active(const InterfaceOperator &W, unsigned int group, const PairEquations *present);

    /** Assembles the block of joint @p group. This process must hold it. Call it after find_active(). */
    void assemble(const InterfaceOperator &W, unsigned int group);

    /** Computes the LU decomposition. */
    void factorise();

    /** Computes x = block^-1 x for @p columns right-hand sides of the active rows. */
    void solve(float *x, int columns) const;

    int size() const { return static_cast<int>(active.size()); } ///< number of active rows

    std::vector<unsigned int>  active; ///< rows of the group that are not trivial
    std::vector<float>         lu;     ///< by column
    std::vector<int>           pivots;
    std::vector<PairEquations> equations; ///< equations of the assembled block
  };
} // namespace Voussoir

#endif
