// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_statics_h
#define voussoir_rock_statics_h

#include <voussoir/base/log.h>
#include <voussoir/base/node_matrix.h>

#include <memory>

namespace Voussoir
{
  /** Static displacements of the rock: conjugate gradients (deal.II's SolverCG), preconditioned by the
   * smoothed aggregation of Trilinos' ML, whose coarse spaces hold the six motions of a rigid body (Vanek,
   * Mandel and Brezina 1996, Computing 56). The number of iterations hardly depends on the size of the
   * elements.
   *
   * A solve begins with the A-orthogonal projection of its solution on the solutions so far (Fischer 1998,
   * Comput. Methods Appl. Mech. Engrg. 163), since the loads of an iteration differ by less and less.
   *
   * With several ranks the first one solves for all: a solution by all would differ in the order of its
   * tolerance from one number of ranks to the next, and what slides later would make much of that.
   *
   * ML needs MPI, which is started here when nobody has, for this process alone, and ended with the program.
   */
  class RockStatics
  {
  public:
    /** @p stiffness: of all nodes [N/m], at @p points [m]; the nodes that are @p held do not move. Throws
     * ComputationError where ML cannot make its levels. */
    RockStatics(const BlockSparseMatrix &stiffness, const std::vector<std::array<double, 3>> &points,
                const std::vector<bool> &held);
    ~RockStatics();

    unsigned int n_unknowns() const { return static_cast<unsigned int>(3 * free_node.size()); }
    double       seconds_setup() const { return setup; }

    /** Displacements @p x of all nodes [m] under the forces @p b [N], until the residual is less than
     * @p tolerance times |b|; returns the number of iterations. Says where it stands in @p log every ten
     * seconds. Throws ComputationError if it does not converge. */
    unsigned int solve(const Unknowns &b, Unknowns &x, Log &log, double tolerance = 1e-11);

  private:
    struct Multigrid;
    void make_levels(const BlockSparseMatrix &stiffness, const std::vector<std::array<double, 3>> &points);
    unsigned int solve_here(const Unknowns &b, Unknowns &x, Log &log, double tolerance);

    std::vector<unsigned int>  free_node;
    std::unique_ptr<Multigrid> multigrid;
    double                     setup = 0.; ///< [s]
  };
} // namespace Voussoir

#endif
