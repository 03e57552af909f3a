// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_coarse_rock_h
#define voussoir_coarse_rock_h

#include <voussoir/foundation/rock_aggregates.h>

#include <memory>

namespace Voussoir
{
  /** Approximate solver for the coarse problem of RockStatics: one cycle of smoothed aggregation by Trilinos'
   * ML. The coarse spaces contain the six rigid body motions. The problem has about 1/100 of the unknowns and
   * 1/10 of the matrix entries of the rock, and runs on one process.
   *
   * ML needs MPI. The constructor initialises MPI for this process if necessary. */
  class CoarseRock
  {
  public:
    /** Creates the levels. The blocks of a row of @p stiffness must be contiguous. Throws ComputationError if
     * ML fails. */
    CoarseRock(const RockAggregates &aggregates, std::vector<CoarseBlock> &&stiffness);
    ~CoarseRock();

    /** Computes the @p motions for the @p forces, six values per aggregate (RigidMotion). */
    void solve(const std::vector<double> &forces, std::vector<double> &motions) const;

  private:
    struct Multigrid;
    std::unique_ptr<Multigrid> multigrid;
  };
} // namespace Voussoir

#endif
