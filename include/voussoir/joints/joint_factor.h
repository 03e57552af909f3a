// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_factor_h
#define voussoir_joint_factor_h

#include <voussoir/joints/interface_operator.h>

namespace Voussoir
{
  /** The row says: this component of the force is given. */
  bool row_is_trivial(const PairEquations &equations, unsigned int component);

  /** A joint's own block of J = d_force + d_gap W, in the rows and columns that are not trivial, and its LU
   *  decomposition, in single precision. */
  struct JointFactor
  {
    /** Takes the equations of joint @p group; @p present: that of its first pair, the others following. */
    void find_active(const InterfaceOperator &W, unsigned int group, const PairEquations *present);

    /** The block of joint @p group, which must be held here; after find_active(). */
    void assemble(const InterfaceOperator &W, unsigned int group);

    void factorise();

    /** x = block^-1 x for @p columns right-hand sides of the active rows. */
    void solve(float *x, int columns) const;

    int size() const { return static_cast<int>(active.size()); }

    std::vector<unsigned int>  active; ///< rows of the group that are not trivial
    std::vector<float>         lu;     ///< column by column
    std::vector<int>           pivots;
    std::vector<PairEquations> equations; ///< what it was made from
  };
} // namespace Voussoir

#endif
