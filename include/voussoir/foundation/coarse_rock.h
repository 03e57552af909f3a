// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_coarse_rock_h
#define voussoir_coarse_rock_h

#include <voussoir/foundation/rock_aggregates.h>

#include <functional>
#include <memory>

namespace Voussoir
{
  /** Solver for the coarse problem of RockStatics, exact or approximate. The problem has about 1/12 of
   * the unknowns of the rock, up to 1/7 with flat elements, and runs on one process. */
  class CoarseRock
  {
  public:
    virtual ~CoarseRock() = default;

    /** Computes the @p motions for the @p forces, six values per aggregate (RigidMotion). */
    virtual void solve(const std::vector<double> &forces, std::vector<double> &motions) const = 0;
  };

  /** Function that creates a coarse solver. The blocks of a row of the stiffness must be contiguous. */
  using MakeCoarseRock =
      std::function<std::unique_ptr<CoarseRock>(const RockAggregates &, std::vector<CoarseBlock> &&)>;

  /** Returns the sum of the diagonal of a @p stiffness that keeps it positive definite: 1e-6 of its largest
   * entry. Aggregates with one or two nodes have rotations without stiffness. */
  float coarse_shift(const std::vector<CoarseBlock> &stiffness);

  /** Creates a solver with the Cholesky factor of the matrix, by CHOLMOD. Throws ComputationError if the matrix
   * is not positive definite. */
  std::unique_ptr<CoarseRock> make_direct_coarse_rock(const RockAggregates      &aggregates,
                                                      std::vector<CoarseBlock> &&stiffness);

  /** Creates a solver with one cycle of smoothed aggregation, by Trilinos' ML. The coarse spaces contain the six
   * rigid body motions. ML needs MPI, which is initialised for this process if necessary. Throws
   * ComputationError if ML fails. Exists in a program with Trilinos only (VOUSSOIR_WITH_TRILINOS). */
  std::unique_ptr<CoarseRock> make_multigrid_coarse_rock(const RockAggregates      &aggregates,
                                                         std::vector<CoarseBlock> &&stiffness);

  /** Creates the default solver: ML in a program with Trilinos, otherwise CHOLMOD. */
  std::unique_ptr<CoarseRock> make_coarse_rock(const RockAggregates      &aggregates,
                                               std::vector<CoarseBlock> &&stiffness);

  /** Returns the least coupling of two nodes of one aggregate that suits make_coarse_rock() [-]. */
  double strong_coupling();
} // namespace Voussoir

#endif
