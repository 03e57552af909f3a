// SPDX-License-Identifier: GPL-3.0-or-later
// Rock of unit speed and the wave that goes into it, for the tests of the explicit region.

#ifndef voussoir_tests_box_h
#define voussoir_tests_box_h

#include "grids.h"
#include "testing.h"

#include <voussoir/rock/rock_region.h>

#include <algorithm>
#include <cmath>
#include <random>
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
    const auto region = make_region(model, parameters);
    region->fix(fixed);
    std::mt19937 engine(7);
    Unknowns     u(3 * std::size_t(region->n_nodes()), 0.), v = u;
    for (double &x : v)
      x = engine() / 2147483647.5 - 1.;
    for (const BoundaryLine &line : model.lines)
      std::fill_n(v.begin() + 3 * std::size_t(line.nodes[0]), 3, 0.);
    region->keep_energy();
    region->start(u, v);
    double early = 0.;
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
} // namespace Boxes

#endif
