// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_coarse_rock_h
#define voussoir_coarse_rock_h

#include <voussoir/foundation/rock_aggregates.h>

#include <memory>

namespace Voussoir
{
  /** The equilibrium of aggregates of the rock, about: one cycle of the smoothed aggregation of Trilinos' ML,
   * whose coarse spaces hold the six motions of a rigid body. By one process, for it is small: some hundredth
   * of the unknowns, some tenth of the numbers.
   *
   * ML needs MPI, which is started here when nobody has, for this process alone, and ended with the program.
   */
  class CoarseRock
  {
  public:
    /** Blocks of a row of @p stiffness are to stand together. Throws ComputationError where it cannot. */
    CoarseRock(const RockAggregates &aggregates, std::vector<CoarseBlock> &&stiffness);
    ~CoarseRock();

    /** Motions for @p forces, six numbers of each aggregate. */
    void solve(const std::vector<double> &forces, std::vector<double> &motions) const;

  private:
    struct Multigrid;
    std::unique_ptr<Multigrid> multigrid;
  };
} // namespace Voussoir

#endif
