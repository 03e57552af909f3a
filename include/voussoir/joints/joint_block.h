// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_block_h
#define voussoir_joint_block_h

#include <voussoir/joints/joint_factor.h>

namespace Voussoir
{
  /** A joint's own block D = d_force + d_gap W_jj of Newton's equations, ready to be solved, in single
   * precision.
   *
   * With the stiffness F = W_jj^-1 of the joint alone, made once when it is first of use, the unknown is the
   * change y of the gap, the force's change is z = F y. Where pairs stick, y is given by their equations;
   * only open pairs and the directions of slip are unknown, which are few: a small system (d_force F + d_gap)
   * y = r remains, and y = W_jj z costs nothing. Where most pairs are open the unknown is z instead, known at
   * the open pairs (JointFactor); so, too, where F is no better than single precision can tell. */
  class JointBlock
  {
  public:
    /** Of joint @p group of @p W, which must outlive this. */
    void initialise(const InterfaceOperator &W, unsigned int group);

    /** Takes the equations of the joint's first pair and the others following; keeps the factors of similar
     * ones, which precondition as well. Returns whether it made new ones. */
    bool update(const PairEquations *present);

    void forget() { factor.equations.clear(); } ///< the factors that it has

    /** z = D^-1 r, y = W_jj z. */
    void solve(const float *r, float *z, float *y) const;

    bool holds_inverse() const { return !F.empty(); } ///< has F been made?

  private:
    bool is_similar(const PairEquations *present) const;
    void find_rows();
    bool has_inverse();
    void make_inverse();
    void check_inverse();
    void multiply_by_W(const float *z, float *y) const;
    void factorise();
    void solve_for_gap(const float *r, float *z, float *y) const;
    void solve_for_force(const float *r, float *z, float *y) const;

    const InterfaceOperator  *W = nullptr;
    unsigned int              group = 0, n = 0;
    std::size_t               leading = 0; ///< dimension of F
    std::vector<float>        F;           ///< by column; empty: of no use
    bool                      tried_inverse = false;
    bool                      is_accurate = false; ///< is W_jj F = I to single precision?
    JointFactor               factor; ///< of either system; its equations are those of the factor
    bool                      for_gap = false;
    std::vector<unsigned int> given_force; ///< rows in which the equations give the force
    std::vector<unsigned int> given_gap;   ///< rows in which they give the gap
    std::vector<unsigned int> unknown;     ///< rows in which they do not
  };
} // namespace Voussoir

#endif
