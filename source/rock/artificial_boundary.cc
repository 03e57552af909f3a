// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/rock/artificial_boundary.h>

#include <algorithm>

namespace Voussoir
{
  void ArtificialBoundary::check(const RockRegionParameters &, double) const {}

  std::string ArtificialBoundary::warning(const RockRegionParameters &) const
  {
    return "";
  }

  void ArtificialBoundary::check_prescribed(const std::vector<unsigned int> &) const {}

  void ArtificialBoundary::start(const RegionStep &) {}

  double work_of_motion(const RegionStep &step, const std::vector<unsigned int> &nodes,
                        const Unknowns &w_before)
  {
    double sum = 0.;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t k = 3 * std::size_t(nodes[i]) + c;
        const double      m = step.mass[nodes[i]], old = w_before[3 * i + c],
                     f = step.force.empty() ? 0. : step.force[k];
        const double reaction = m * ((step.w[k] - old) / step.dt + step.damping.mass * old) + step.K_x[k] - f;
        sum += .5 * step.dt * reaction * (old + step.w[k]);
        step.work[lost_in_damping] +=
            .5 * step.dt * (step.damping.mass * m * old + step.K_x[k] - step.K_u[k]) * step.w[k];
        step.work[done_by_forces] += .5 * step.dt * f * step.w[k];
      }
    return sum;
  }

  void check_apart(const std::vector<unsigned int> &nodes, const std::vector<unsigned int> &prescribed,
                   const unsigned int layers)
  {
    std::vector<unsigned int> sorted = prescribed;
    std::sort(sorted.begin(), sorted.end());
    for (const unsigned int node : nodes)
      if (std::binary_search(sorted.begin(), sorted.end(), node))
        throw InputError(
            "the base of the dam is too near the artificial boundary of the rock: there must be " +
            std::to_string(layers) + " layers of rock cells between them for this artificial boundary");
  }
} // namespace Voussoir
