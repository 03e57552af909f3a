// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_growth_h
#define voussoir_growth_h

#include <voussoir/rock/rock_region.h>

namespace Voussoir
{
  /** Largest growth of the motion per time step that counts as stable. */
  constexpr double largest_growth = 1e-5;

  /** Returns the region of a model with its boundary, an energy balance and random velocities, except on the
   * boundary. @p fixed: components 3 node + c without motion. */
  std::unique_ptr<ExplicitRegion> region_with_noise(const RockModel                 &model,
                                                    const RockRegionParameters      &parameters,
                                                    const std::vector<unsigned int> &fixed = {});

  /** Returns the growth per time step of the motion in a small box of rock with an artificial boundary: the
   * logarithm of the largest factor of the one-step operator, by 24,000 power steps from noise. A negative
   * result is a bound: the measurement ends when the motion has decayed. The box has 12 x 12 x 12 cubes,
   * the largest Poisson's ratio of the rock, the boundary, the quadrature and the elements at the dam of @p
   * parameters, and the same ratios of time step, critical time step and damping.
   *
   * @param parameters of the region
   * @param critical_time_step of the region [s]
   * @param is_symmetric true: two planes of symmetry at the dam; false: two free vertical faces, without
   * elements of the dam */
  double growth_per_step(const RockRegionParameters &parameters, double critical_time_step,
                         bool is_symmetric);

  /** Throws InputError if the motion in the box grows by more than largest_growth per step. The message
   * proposes a damping without growth. Results are kept for equal settings. Rock whose largest Poisson's
   * ratio is at most 0.25 is not measured, because it is stable with all boundaries
   * (tests/boundary_stability.cc). */
  void check_growth(const RockRegionParameters &parameters, double critical_time_step);
} // namespace Voussoir

#endif
