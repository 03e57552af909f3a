// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_material_h
#define voussoir_material_h

namespace Voussoir
{
  struct Material
  {
    double young = 21e9, poisson = .17, density = 2400.; ///< [Pa], [-], [kg/m^3]
  };

  /** Wave speeds [m/s]. */
  double p_wave_speed(const Material &material);
  double s_wave_speed(const Material &material);

  /** Rayleigh damping of the rock: C = mass M + stiffness K [1/s], [s]. */
  struct RayleighDamping
  {
    double mass = 0., stiffness = 0.;
  };
} // namespace Voussoir

#endif
