// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_contact_operator_h
#define voussoir_contact_operator_h

#include <voussoir/contact/joint_law.h>

#include <functional>
#include <memory>

namespace Voussoir
{
  /** Linear systems of Newton's method with the matrix J = d_force + d_gap W. Both factors have one 3x3 block
   * per pair, see PairEquations. */
  class ContactJacobian
  {
  public:
    virtual ~ContactJacobian() = default;

    /** Starts a new contact problem and discards the data of earlier ones. Otherwise results would depend on
     * the step at which a run was resumed. */
    virtual void begin() {}

    /** Announces a problem in which distant pairs are coupled, as in statics. solve() may then
     * choose another preconditioner. */
    virtual void expect_far_coupling() {}

    /** Sets the linearised equations, one per pair, and factorises what solve() requires. The equations must
     * remain valid until the next call. Returns the number of factorisations. */
    virtual unsigned int update(const std::vector<PairEquations> &equations) = 0;

    /** Computes step = -J^-1 residual and d_gap = W step in the precision of the solver.
     * @param tolerance relative residual of the linear system
     * @param step change of the forces, three values per pair [N]
     * @param d_gap change of the gaps, three values per pair [m]
     *
     * Returns the number of iterations. */
    virtual unsigned int solve(double tolerance, Unknowns &step, Unknowns &d_gap) = 0;
  };

  /** Linear operator W of the contact problem gap = W force + b [m/N], with three unknowns per pair. */
  class ContactOperator
  {
  public:
    /** Returns the force of one pair [N]. @p H: diagonal block of W; @p b: gap of the pair without
     * its force [m]. */
    using PairSolver = std::function<Vector3(unsigned int pair, const Matrix3 &H, const Vector3 &b)>;

    virtual ~ContactOperator() = default;
    virtual unsigned int n_pairs() const = 0;                   ///< returns the number of pairs
    virtual Matrix3      diagonal(unsigned int pair) const = 0; ///< returns the 3x3 block of a pair
    virtual void         multiply(const Unknowns &x, Unknowns &y) const = 0; ///< computes y = W x

    /** Performs one Gauss-Seidel iteration over the pairs. It keeps @p gap = W force + b if
     * is_in_blocks() is true. */
    virtual void sweep(const PairSolver &solve_pair, Unknowns &force, Unknowns &gap) const = 0;

    /** Distributes values that the pair solver has written on several ranks in sweep(). Entries begin[p] to
     * begin[p+1] - 1 of the first argument belong to pair p. */
    virtual void gather_pairs(Unknowns & /*values*/, const std::vector<std::size_t> & /*begin*/) const {}

    /** Returns whether sweep() uses all entries of W. If not, the gap must be computed
     * again after sweep(). */
    virtual bool is_in_blocks() const { return true; }

    /** Returns a solver for the linear systems of Newton's method. It holds a reference to this operator. */
    virtual std::unique_ptr<ContactJacobian> make_jacobian() const = 0;
  };
} // namespace Voussoir

#endif
