// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_temperature_h
#define voussoir_temperature_h

#include <voussoir/dam/load_parameters.h>
#include <voussoir/solid/initial_strain.h>

namespace Voussoir
{
  /** Temperatures of the upstream and the downstream face [degC]: of the day in the table, if there is one.
   *  @p directory: of the scene, to which the table's path is relative. Throws InputError, with file and
   * line, for what is no table of days in ascending order, and for a day that it does not have. */
  std::array<double, 2> face_temperatures(const TemperatureParameters &temperature,
                                          const std::string           &directory);

  /** Load and stress of the temperature less that of the grouting, linear between the faces by
   * places_in_thickness(). @p to_base: see initial_strain(). */
  InitialStrain temperature_load(const SolidModel &model, const std::vector<Material> &materials,
                                 bool incompatible_modes, const TemperatureParameters &temperature,
                                 const std::string &directory, bool to_base = false);
} // namespace Voussoir

#endif
