// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_block_h
#define voussoir_joint_block_h

#include <voussoir/joints/joint_factor.h>

namespace Voussoir
{
  /** Diagonal block D = d_force + d_gap W_jj of the Newton equations of a joint, with a solver in single
   * precision. It chooses the unknown from the states of the pairs:
   * - gap change y, if most pairs stick: F = W_jj^-1 is the stiffness of the joint alone, computed once when
   *   first needed. The force change is z = F y. The equations of sticking rows give y. Only open pairs and
   *   slip directions are unknown, in a small system (d_force F + d_gap) y = r. The product y = W_jj z needs
   *   no extra work;
   * - force change z, if most pairs are open: z is known at open pairs (JointFactor). Also used if F is not
   *   accurate in single precision. */
  class JointBlock
  {
  public:
    /** Selects the joint @p group of @p W, which must outlive the object. */
    void initialise(const InterfaceOperator &W, unsigned int group);

    /** Sets the equations of the pairs of the joint. @p present: equations of the first pair, followed by the
     * others. Factors of similar equations are kept, because they precondition as well. Returns true if
     * factors were computed. */
    bool update(const PairEquations *present);

    void forget() { factor.equations.clear(); } ///< discards the factors

    /** Computes z = D^-1 r and y = W_jj z. */
    void solve(const float *r, float *z, float *y) const;

    bool holds_inverse() const { return !F.empty(); } ///< returns whether F exists

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
    std::size_t               leading = 0; ///< leading dimension of F
    std::vector<float>        F;           ///< by column; empty: not used
    bool                      tried_inverse = false;
    bool                      is_accurate = false; ///< W_jj F = I in single precision
    JointFactor               factor;              ///< factor of either system, with its equations
    bool                      for_gap = false;     ///< the unknown is y
    std::vector<unsigned int> given_force;         ///< rows with given force
    std::vector<unsigned int> given_gap;           ///< rows with given gap
    std::vector<unsigned int> unknown;             ///< other rows
    std::vector<unsigned int> near_rows; ///< all rows of each pair with a row in factor, if the unknown is y
  };
} // namespace Voussoir

#endif
