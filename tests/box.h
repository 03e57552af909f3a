// SPDX-License-Identifier: GPL-3.0-or-later
// Rock of unit speed and the wave that goes into it, for the tests of the explicit region.

#ifndef voussoir_tests_box_h
#define voussoir_tests_box_h

#include "grids.h"
#include "testing.h"

#include <voussoir/rock/rock_region.h>

#include <cmath>

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
} // namespace Boxes

#endif
