// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_contact_operator_h
#define voussoir_contact_operator_h

#include <voussoir/contact/joint_law.h>

#include <functional>
#include <memory>

namespace Voussoir
{
  /** The linear systems of Newton's method: J = d_force + d_gap W, one 3x3 block of both per pair. */
  class ContactJacobian
  {
  public:
    virtual ~ContactJacobian() = default;

    /** A new problem: what it kept of those before would let a solution depend on where a run was resumed. */
    virtual void begin() {}

    /** The pairs will feel each other from afar, as in statics: solve() may prepare for that. */
    virtual void expect_far_coupling() {}

    /** Take new equations, one per pair, which must outlive the solutions; factorise what needs it. Returns
     *  the number of factorisations. */
    virtual unsigned int update(const std::vector<PairEquations> &equations) = 0;

    /** step = -J^-1 residual, to @p tolerance relative to the residual; d_gap = W step, both in the precision
     *  of the solver. Returns its iterations. */
    virtual unsigned int solve(double tolerance, Unknowns &step, Unknowns &d_gap) = 0;
  };

  /** The linear operator of the contact problem gap = W force + b, three unknowns per pair. */
  class ContactOperator
  {
  public:
    /** The force at a pair whose gap would be @p b without it. */
    using PairSolver = std::function<Vector3(unsigned int pair, const Matrix3 &H, const Vector3 &b)>;

    virtual ~ContactOperator() = default;
    virtual unsigned int n_pairs() const = 0;
    virtual Matrix3      diagonal(unsigned int pair) const = 0;
    virtual void         multiply(const Unknowns &x, Unknowns &y) const = 0; ///< y = W x

    /** One Gauss-Seidel sweep over the pairs; @p gap = W force + b before and after, if is_in_blocks(). */
    virtual void sweep(const PairSolver &solve_pair, Unknowns &force, Unknowns &gap) const = 0;

    /** After a sweep by several ranks: all get what the solver of the pairs has left elsewhere, @p begin[p]
     * to begin[p + 1] of @p values for pair p. */
    virtual void gather_pairs(Unknowns & /*values*/, const std::vector<std::size_t> & /*begin*/) const {}

    /** Does sweep() know all of W? Else its gaps are to be made afresh. */
    virtual bool is_in_blocks() const { return true; }

    virtual std::unique_ptr<ContactJacobian> make_jacobian() const = 0;
  };
} // namespace Voussoir

#endif
