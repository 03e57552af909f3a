// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/solid/material.h>

#include <cmath>

namespace Voussoir
{
  double p_wave_speed(const Material &m)
  {
    return std::sqrt(m.young * (1. - m.poisson) / ((1. + m.poisson) * (1. - 2. * m.poisson) * m.density));
  }

  double s_wave_speed(const Material &m)
  {
    return std::sqrt(m.young / (2. * (1. + m.poisson) * m.density));
  }
} // namespace Voussoir
