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
    constexpr int                      per_chunk = 256; // nodes, added in their order whatever the threads
    const int                          n = nodes.size(), n_chunks = (n + per_chunk - 1) / per_chunk;
    std::vector<std::array<double, 3>> sums(n_chunks); // work, losses, work of forces
#pragma omp parallel for schedule(static) if (n_chunks > 4)
    for (int chunk = 0; chunk < n_chunks; ++chunk)
    {
      double sum = 0., lost = 0., external = 0.;
      for (int i = chunk * per_chunk; i < std::min(n, (chunk + 1) * per_chunk); ++i)
        for (unsigned int c = 0; c < 3; ++c)
        {
          const std::size_t k = 3 * std::size_t(nodes[i]) + c;
          const double      m = step.mass[nodes[i]], old = w_before[3 * std::size_t(i) + c],
                       f = step.force.empty() ? 0. : step.force[k];
          const double reaction =
              m * ((step.w[k] - old) / step.dt + step.damping.mass * old) + step.K_x[k] - f;
          sum += .5 * step.dt * reaction * (old + step.w[k]);
          lost += .5 * step.dt * (step.damping.mass * m * old + step.K_x[k] - step.K_u[k]) * step.w[k];
          external += .5 * step.dt * f * step.w[k];
        }
      sums[chunk] = {{sum, lost, external}};
    }
    double sum = 0.;
    for (const auto &part : sums)
    {
      sum += part[0];
      step.work[lost_in_damping] += part[1];
      step.work[done_by_forces] += part[2];
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
