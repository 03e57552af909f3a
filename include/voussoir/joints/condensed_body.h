// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_condensed_body_h
#define voussoir_condensed_body_h

#include <voussoir/joints/body_factor.h>

namespace Voussoir
{
  /** A body seen through its interface: solves A u = b + G^T f with the joint forces f known only when the
   *  displacement u_G of the interface without them is.
   *
   *  Where the interface is a large part of the body (thin monoliths), an order of elimination that fills
   *  little is worth more than one that keeps the interface apart, and A is solved twice: for b, which gives
   * u_G, and for b + G^T f. Otherwise the interface comes last, a forward sweep condenses the load on it, the
   * flexibility S^-1 gives u_G, and after the joint forces a backward sweep gives u. Whichever reads less is
   * chosen. */
  class CondensedBody
  {
  public:
    /** @p springs: to the ground, per component of the structure [N/m], or empty; @p single: the factor is
     * kept in single precision, right to 6e-8.
     *  Throws ComputationError when A is not positive definite (a body that nothing holds, or bad elements),
     *  and std::bad_alloc. */
    CondensedBody(const Structure &structure, const Body &body, double mass_factor, double stiffness_factor,
                  double dashpot_factor, const Unknowns &springs = Unknowns(), bool single = false);

    /** @p b: 3 n_nodes, the body's part of the load; @p u_G: receives n_interface() entries, the displacement
     * without joint forces. */
    void apply_load(const double *b, double *u_G);

    /** @p f: n_interface() joint forces; @p u: receives 3 n_nodes. After apply_load(). */
    void apply_joint_forces(const double *f, double *u);

    /** A u = b without joint forces. */
    void solve(const double *b, double *u);

    /** Is A solved twice, in an order without regard to the interface? */
    bool has_free_order() const { return free_order; }

    /** Unknowns; component c of node number i of body.interface is number 3 i + c. */
    unsigned int n_interface() const { return static_cast<unsigned int>(interface_row.size()); }

    /** S^-1 of the condensed operator S, n_interface() x n_interface(), column by column (it is symmetric)
     *  [m/N]; once. */
    std::vector<double> take_flexibility();

    double memory() const; ///< [bytes]

  private:
    std::vector<unsigned int> permutation;   ///< unknown of the body at each row of the factor
    std::vector<unsigned int> interface_row; ///< row of each unknown of the interface
    PackedFactor              factor;
    bool                      free_order;  ///< else the interface comes last
    std::vector<double>       flexibility; ///< column by column
    std::vector<double>       load, x;     ///< work space, in the order of the factor
    std::vector<double>       condensed_load;
  };
} // namespace Voussoir

#endif
