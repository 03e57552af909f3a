// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_temperature_h
#define voussoir_temperature_h

#include <voussoir/dam/load_parameters.h>
#include <voussoir/solid/initial_strain.h>

namespace Voussoir
{
  /** Temperatures of both faces on one day. They are linear between elevations, and constant below the lowest
   * and above the highest elevation. */
  struct FaceTemperatures
  {
    std::vector<double> elevation; ///< ascending [m]; one unused value if there is no dependence

    std::vector<std::array<double, 2>> faces; ///< upstream and downstream, one per elevation [degC]

    /** Returns the temperatures of the upstream and the downstream face at the elevation @p z [degC]. */
    std::array<double, 2> at(double z) const;
  };

  /** Returns the temperatures of the faces, from the table if there is one. @p directory: directory of the
   * input file, to which the path of the table is relative. Throws InputError, with file and line, for a
   * malformed table and for a day outside of it. */
  FaceTemperatures face_temperatures(const TemperatureParameters &temperature, const std::string &directory);

  /** Returns the load [N] and the stress [Pa] of the temperature change since grouting. The temperature is
   * linear between the faces (places_in_thickness()) and follows the elements between their nodes. @p to_base:
   * see initial_strain(). */
  InitialStrain temperature_load(const SolidModel &model, const std::vector<Material> &materials,
                                 bool incompatible_modes, const TemperatureParameters &temperature,
                                 const std::string &directory, bool to_base = false);
} // namespace Voussoir

#endif
