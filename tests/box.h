// SPDX-License-Identifier: GPL-3.0-or-later
// Rock of unit speed and the wave that goes into it, for the tests of the explicit region.

#ifndef voussoir_tests_box_h
#define voussoir_tests_box_h

#include "grids.h"
#include "testing.h"

#include <voussoir/rock/growth.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace Boxes
{
  using namespace Voussoir;

  using Grids::box;
  using Testing::pi;

  constexpr int rock = PhysicalId::first_rock; ///< the volume of a box

  /** c_s = 1 m/s, density 1 kg/m^3. */
  inline Material unit_rock(const double nu = .25)
  {
    Material m;
    m.density = 1.;
    m.poisson = nu;
    m.young = 2. * (1. + nu);
    return m;
  }

  /** Ricker wavelet with the dominant frequency @p f, its peak 1 at @p t0. */
  inline double ricker(const double t, const double f, const double t0)
  {
    const double a = pi * f * (t - t0);
    return (1. - 2. * a * a) * std::exp(-a * a);
  }

  /** Returns the kinetic energy of a region after @p n_steps steps from random motion, relative to that after
   * a tenth of the steps: below 1 if it is stable. @p fixed: components 3 node + c without motion. */
  inline double noise_growth(const RockModel &model, const RockRegionParameters &parameters,
                             const unsigned int n_steps = 2000, const std::vector<unsigned int> &fixed = {})
  {
    const auto region = region_with_noise(model, parameters, fixed);
    double     early = 0.;
    for (unsigned int i = 1; i <= n_steps; ++i)
    {
      region->advance();
      if (i == n_steps / 10)
        early = region->energy().kinetic;
      if (!(region->energy().kinetic < 1e100))
        return HUGE_VAL;
    }
    return region->energy().kinetic / early;
  }

  /** Differences between a region and a free field. */
  struct Difference
  {
    double error = 0.,
           peak = 0.;         ///< largest difference and largest motion of the free field, at all nodes [m]
    double energy_error = 0.; ///< of the energy balance, relative to the largest energy
  };

  /** Returns the differences between the region of a model and its free field of the type @p expected_of. NaN counts
   * as the largest difference. */
  inline Difference difference(const RockModel &model, const RockRegionParameters &p,
                               const IncidentWave &wave, const std::string &expected_of,
                               const unsigned int n_steps)
  {
    auto region = make_region(model, p);
    shake(*region, model, p, wave, n_steps);
    region->keep_energy();
    RockRegionParameters other = p;
    other.free_field = expected_of;
    const auto                field = make_free_field(model, other, wave, n_steps);
    std::vector<unsigned int> all(model.points.size());
    for (unsigned int i = 0; i < all.size(); ++i)
      all[i] = i;
    field->add_nodes(model, all);
    const auto larger = [](const double a, const double b) { return a >= b ? a : b; };
    Unknowns   expected;
    Difference result;
    double     largest = 0.;
    for (unsigned int i = 0; i < n_steps; ++i)
    {
      region->advance();
      field->advance();
      field->evaluate(expected);
      for (unsigned int k = 0; k < expected.size(); ++k)
      {
        result.error = larger(result.error, std::abs(region->displacement()[k] - expected[k]));
        result.peak = larger(result.peak, std::abs(expected[k]));
      }
      largest = std::max(largest, region->energy().kinetic + region->energy().strain);
      result.energy_error = larger(result.energy_error, std::abs(region->energy().balance()));
    }
    result.energy_error /= largest;
    return result;
  }
} // namespace Boxes

#endif
