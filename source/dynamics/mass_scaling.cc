// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/dynamics/leapfrog.h>
#include <voussoir/dynamics/mass_scaling.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    /** Returns the largest sum of the absolute values of a row of each node [N/m]. */
    std::vector<double> row_sums(const Structure &structure)
    {
      std::vector<double> result(structure.n_nodes(), 0.);
      for (const Body &body : structure.bodies)
        for (unsigned int row = 0; row < body.n_nodes(); ++row)
        {
          Vector3 sum{};
          for (std::size_t k = body.stiffness.start[row]; k < body.stiffness.start[row + 1]; ++k)
            for (unsigned int c = 0; c < 9; ++c)
              sum[c / 3] += std::abs(body.stiffness.value[k][c]);
          result[body.first_node + row] = *std::max_element(sum.begin(), sum.end());
        }
      return result;
    }
  } // namespace

  std::vector<double> mass_scaling(const Structure &structure, const std::vector<Matrix3> &without,
                                   const double step)
  {
    if (critical_step(structure, without).length >= step)
      return {};
    const std::vector<double> sums = row_sums(structure);
    Structure                 scaled = structure;
    std::vector<double>       result;
    const auto                reaches = [&](const double limit) // [1/s^2]
    {
      result.assign(sums.size(), 0.);
      scaled.mass = structure.mass;
      for (std::size_t i = 0; i < sums.size(); ++i)
      {
        const double mass = mass_of(structure, without, i);
        result[i] = std::max(0., sums[i] / limit - mass);
        for (unsigned int c = 0; c < 3; ++c)
          scaled.mass[i][4 * c] += result[i];
      }
      return critical_step(scaled, without).length >= step;
    };
    double safe = 4. / (step * step), unsafe = safe;
    while (!reaches(safe)) // for the damping, which raises the frequencies
      safe *= .5;
    while (reaches(unsafe))
      unsafe *= 2.;
    while (unsafe > 1.02 * safe)
      (reaches(std::sqrt(safe * unsafe)) ? safe : unsafe) = std::sqrt(safe * unsafe);
    reaches(safe);
    return result;
  }
} // namespace Voussoir
