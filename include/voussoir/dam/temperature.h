// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_temperature_h
#define voussoir_temperature_h

#include <voussoir/dam/load_parameters.h>
#include <voussoir/solid/initial_strain.h>

namespace Voussoir
{
  /** Returns the temperatures of the upstream and the downstream face [degC], from the table if there is one.
   * @p directory: directory of the input file, to which the path of the table is relative. Throws InputError,
   * with file and line, for a malformed table and for a day outside of it. */
  std::array<double, 2> face_temperatures(const TemperatureParameters &temperature,
                                          const std::string           &directory);

  /** Returns the load [N] and the stress [Pa] of the temperature change since grouting. The temperature is
   * linear between the faces (places_in_thickness()). @p to_base: see initial_strain(). */
  InitialStrain temperature_load(const SolidModel &model, const std::vector<Material> &materials,
                                 bool incompatible_modes, const TemperatureParameters &temperature,
                                 const std::string &directory, bool to_base = false);
} // namespace Voussoir

#endif
