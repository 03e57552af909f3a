// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_condensed_body_h
#define voussoir_condensed_body_h

#include <voussoir/joints/body_factor.h>

namespace Voussoir
{
  /** Body condensed to its interface. It solves A u = b + G^T f. The joint forces f depend on the
   * displacement u_G of the interface without joint forces.
   *
   * One of two orders of elimination is chosen, the one with less memory traffic:
   * - free order: A is solved twice, for b, which gives u_G, and for b + G^T f. It suits thin monoliths,
   *   where the interface is a large part of the body;
   * - interface last: a forward substitution condenses the load, the flexibility S^-1 gives u_G, and a
   *   backward substitution with the joint forces gives u. */
  class CondensedBody
  {
  public:
    /** Factorises the operator A of @p step for @p body. @p springs: springs to the ground, per component of
     * the structure [N/m]; empty: none. @p single: stores the factor in single precision, with a relative
     * error of 6e-8.
     *
     * Throws ComputationError if A is not positive definite (no support, or distorted
     * elements), and std::bad_alloc. */
    CondensedBody(const Structure &structure, const Body &body, const StepOperator &step,
                  const Unknowns &springs = Unknowns(), bool single = false);
    CondensedBody(CondensedBody &&) noexcept;
    ~CondensedBody();

    /** Computes the displacement of the interface without joint forces.
     * @param b load of the body, three values per node [N]
     * @param u_G receives n_interface() values [m] */
    void apply_load(const double *b, double *u_G);

    /** Computes the displacement of the body with the joint forces. Call it after apply_load().
     * @param f joint forces, n_interface() values [N]
     * @param u receives three values per node [m] */
    void apply_joint_forces(const double *f, double *u);

    /** Solves A u = b without joint forces. */
    void solve(const double *b, double *u);

    /** Returns true for the free order, in which A is solved twice. */
    bool has_free_order() const { return free_order; }

    /** Returns the number of unknowns of the interface. Component c of node i of body.interface has the
     * number 3 i + c. */
    unsigned int n_interface() const { return static_cast<unsigned int>(interface_row.size()); }

    /** Returns the inverse S^-1 of the condensed operator, n_interface() x n_interface(), by column
     * (symmetric) [m/N]. Call it once. */
    std::vector<double> take_flexibility();

    double memory() const; ///< memory consumption [bytes]

  private:
    std::vector<unsigned int>     permutation;   ///< unknown of the body at each row of the factor
    std::vector<unsigned int>     interface_row; ///< row of each unknown of the interface
    std::unique_ptr<PackedFactor> factor;
    bool                          free_order;  ///< false: interface last
    std::vector<double>           flexibility; ///< column by column
    std::vector<double>           load, x;     ///< work space, in the order of the factor
    std::vector<double>           condensed_load;
  };
} // namespace Voussoir

#endif
