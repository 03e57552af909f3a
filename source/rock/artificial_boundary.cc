// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/rock/artificial_boundary.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace Voussoir
{
  void ArtificialBoundary::check(const RockRegionParameters &) const {}

  std::string ArtificialBoundary::warning(const RockRegionParameters &) const
  {
    return "";
  }

  double ArtificialBoundary::largest_step(const RockModel &) const
  {
    return std::numeric_limits<double>::infinity();
  }

  void ArtificialBoundary::check_prescribed(const std::vector<unsigned int> &) const {}

  void ArtificialBoundary::start(const RegionStep &) {}

  void ArtificialBoundary::keep(const std::vector<bool> &)
  {
    throw InputError(
        "The artificial boundary of \"Foundation/Boundary\" supports one MPI process only. Start the program "
        "without mpirun, or choose another boundary.");
  }

  std::vector<unsigned int> all_of(const std::size_t n)
  {
    std::vector<unsigned int> result(n);
    std::iota(result.begin(), result.end(), 0);
    return result;
  }

  std::vector<unsigned int> stepped_of(const std::vector<unsigned int> &nodes,
                                       const std::vector<bool>         &stepped)
  {
    std::vector<unsigned int> result;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (stepped[nodes[i]])
        result.push_back(i);
    return result;
  }

  void add_work_of_motion(const RegionStep &step, const std::vector<unsigned int> &nodes,
                          const std::vector<unsigned int> &kept, const Unknowns &w_before,
                          const RegionWork kind, const double factor)
  {
    const int                          n = kept.size();
    std::vector<std::array<double, 3>> sums(n); // work, losses, work of forces
#pragma omp parallel for schedule(static) if (n > 1000)
    for (int k = 0; k < n; ++k)
    {
      const unsigned int i = kept[k];
      double             sum = 0., lost = 0., external = 0.;
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t at = 3 * std::size_t(nodes[i]) + c;
        const double      m = step.mass[nodes[i]], old = w_before[3 * std::size_t(i) + c],
                     f = step.force.empty() ? 0. : step.force[at];
        const double reaction =
            m * ((step.w[at] - old) / step.dt + step.damping.mass * old) + step.K_x[at] - f;
        sum += .5 * step.dt * reaction * (old + step.w[at]);
        lost += .5 * step.dt * (step.damping.mass * m * old + step.K_x[at] - step.K_u[at]) * step.w[at];
        external += .5 * step.dt * f * step.w[at];
      }
      sums[k] = {{sum, lost, external}};
    }
    for (int k = 0; k < n; ++k) // in sequence for any number of threads
    {
      step.add_work(kind, nodes[kept[k]], factor * sums[k][0]);
      step.add_work(lost_in_damping, nodes[kept[k]], sums[k][1]);
      step.add_work(done_by_forces, nodes[kept[k]], sums[k][2]);
    }
  }

  void check_apart(const std::vector<unsigned int> &nodes, const std::vector<unsigned int> &prescribed,
                   const unsigned int layers)
  {
    std::vector<unsigned int> sorted = prescribed;
    std::sort(sorted.begin(), sorted.end());
    for (const unsigned int node : nodes)
      if (std::binary_search(sorted.begin(), sorted.end(), node))
        throw InputError(
            "The base of the dam is too near the artificial boundary of the rock: this boundary requires at "
            "least " +
            std::to_string(layers) +
            " layers of rock elements between them. Make the rock larger or its elements smaller, or choose "
            "another \"Foundation/Boundary\".");
  }
} // namespace Voussoir
