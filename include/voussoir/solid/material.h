// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_material_h
#define voussoir_material_h

namespace Voussoir
{
  /** Linear elastic, isotropic material: Young's modulus, Poisson's ratio and density. */
  struct Material
  {
    double young = 21e9, poisson = .17, density = 2400.; ///< [Pa], [-], [kg/m^3]
  };

  /** Returns the velocity of compression waves [m/s]. */
  double p_wave_speed(const Material &material);

  /** Returns the velocity of shear waves [m/s]. */
  double s_wave_speed(const Material &material);
} // namespace Voussoir

#endif
