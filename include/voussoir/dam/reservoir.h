// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_reservoir_h
#define voussoir_reservoir_h

#include <voussoir/solid/structure.h>

#include <string>

namespace Voussoir
{
  class Entries;

  class SolidModel;

  struct ReservoirParameters
  {
    double      level = 195.;               ///< z of the water surface [m]
    double      density = 1000.;            ///< 0: empty reservoir [kg/m^3]
    std::string added_mass = "Westergaard"; ///< or Westergaard-nodal, none
    std::string depth = "global";           ///< or local
    double      factor = 1.;                ///< of the added mass [-]

    void add_parameters(Entries &prm);
  };

  /** Hydrostatic pressure on the surface "upstream" below the water level [N]. */
  void add_water_pressure(const SolidModel &model, const ReservoirParameters &reservoir, double gravity,
                          Unknowns &load);

  /** Westergaard's added mass 7/8 rho sqrt(H h) n n^T per area of the surface "upstream", integrated over its
   * wet part and lumped to the nodes as 3x3 blocks in structure.mass and structure.added_mass; h: depth, H:
   * depth of the reservoir (global: at its deepest point; local: in the same vertical section, Kuo 1982). The
   * shares of the nodes are those of the shape functions, as in the lumped mass of the concrete. Returns the
   * total added mass for horizontal motion along x [kg]. */
  double add_westergaard_mass(const SolidModel &model, const ReservoirParameters &reservoir,
                              Structure &structure);

  /** The same by the formula at the nodes and their areas alone. */
  double add_nodal_westergaard_mass(const SolidModel &model, const ReservoirParameters &reservoir,
                                    Structure &structure);

  /** The added mass of that name, in structure.mass and structure.added_mass. Returns the total for
   * horizontal motion along x [kg]. */
  double add_added_mass(const SolidModel &model, const ReservoirParameters &reservoir, Structure &structure);

  /** The added mass per area of the surface "upstream" at the nodes of the model [kg/m^2]; empty: none. */
  std::vector<double> added_mass_per_area(const SolidModel &model, const ReservoirParameters &reservoir);

  std::string added_mass_names(); ///< as a ParameterHandler selection: "Westergaard|Westergaard-nodal|none"
  std::string added_mass_docs();  ///< what they are
} // namespace Voussoir

#endif
