// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_contact_operator_h
#define voussoir_contact_operator_h

#include <voussoir/contact/joint_law.h>

#include <functional>
#include <memory>

namespace Voussoir
{
  /** Solver for the linear systems of Newton's method, with the matrix J = d_force + d_gap W. The matrices
   * d_force and d_gap have one 3x3 block per pair, see PairEquations. W is the ContactOperator. */
  class ContactJacobian
  {
  public:
    virtual ~ContactJacobian() = default;

    /** Starts a new contact problem and discards the data of earlier problems. Results are therefore
     * independent of the step at which a run was resumed. */
    virtual void begin() {}

    /** Announces a problem in which distant pairs are strongly coupled, such as a static problem. solve() may
     * then choose another preconditioner. */
    virtual void expect_far_coupling() {}

    /** Sets the linearised equations of a Newton step and factorises the matrices that solve() requires.
     * @param equations equations of all pairs; must remain valid until the next call
     *
     * Returns the number of factorisations. */
    virtual unsigned int update(const std::vector<PairEquations> &equations) = 0;

    /** Computes a Newton step: step = -J^-1 residual and d_gap = W step. The residual is that of the
     * equations of update(). Both results have the accuracy of the linear solver.
     * @param tolerance largest residual of the linear system, relative to its right-hand side [-]
     * @param step receives the change of the forces, three values per pair [N]
     * @param d_gap receives the change of the gaps, three values per pair [m]
     *
     * Returns the number of iterations of the linear solver. */
    virtual unsigned int solve(double tolerance, Unknowns &step, Unknowns &d_gap) = 0;
  };

  /** Linear operator W of the contact problem gap = W force + b [m/N]: the flexibility of the bodies at the
   * pairs. It has three unknowns per pair. */
  class ContactOperator
  {
  public:
    /** Function that returns the force of one pair [N]. pair: its index. H: diagonal 3x3 block of W [m/N].
     * b: gap of the pair without its force [m]. */
    using PairSolver = std::function<Vector3(unsigned int pair, const Matrix3 &H, const Vector3 &b)>;

    virtual ~ContactOperator() = default;

    /** Returns the number of pairs. */
    virtual unsigned int n_pairs() const = 0;

    /** Returns the diagonal 3x3 block of a pair [m/N]. */
    virtual Matrix3 diagonal(unsigned int pair) const = 0;

    /** Computes @p y = W @p x, with three values per pair. */
    virtual void multiply(const Unknowns &x, Unknowns &y) const = 0;

    /** Performs one Gauss-Seidel iteration over the pairs.
     * @param solve_pair solver of one pair
     * @param force forces before and after the iteration, three values per pair [N]
     * @param gap gaps W force + b before the iteration, three values per pair [m]. After the iteration they
     * agree with the new forces if is_in_blocks() is true. */
    virtual void sweep(const PairSolver &solve_pair, Unknowns &force, Unknowns &gap) const = 0;

    /** Gathers values on all ranks that the pair solver has written in sweep() on the rank of each pair. The
     * first argument contains the values, the second the first index of each pair and the end: values
     * begin[p] to begin[p+1] - 1 belong to pair p. The default is for one rank. */
    virtual void gather_pairs(Unknowns & /*values*/, const std::vector<std::size_t> & /*begin*/) const {}

    /** Returns true if sweep() uses all entries of W. If false, the gap must be computed again after
     * sweep(). */
    virtual bool is_in_blocks() const { return true; }

    /** Returns a solver for the linear systems of Newton's method. This operator must outlive the solver. */
    virtual std::unique_ptr<ContactJacobian> make_jacobian() const = 0;
  };
} // namespace Voussoir

#endif
