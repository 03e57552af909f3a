#ifndef voussoir_dam_loads_h
#define voussoir_dam_loads_h

#include <voussoir/solid/structure.h>

#include <string>

namespace dealii
{
  class ParameterHandler;
}

namespace Voussoir
{
  class SolidModel;

  struct ReservoirParameters
  {
    double      level = 195.;               ///< z of the water surface [m]
    double      density = 1000.;            ///< 0: empty reservoir [kg/m^3]
    std::string added_mass = "Westergaard"; ///< or none
    std::string depth = "global";           ///< or local
    double      factor = 1.;                ///< of the added mass [-]

    void add_parameters(dealii::ParameterHandler &prm);
  };

  /** Weight of the concrete: the lumped masses times @p gravity, downwards [N]. */
  void add_weight(const Structure &structure, double gravity, Unknowns &load);

  /** Hydrostatic pressure on the surface "upstream" below the water level [N]. */
  void add_water_pressure(const SolidModel &model, const ReservoirParameters &reservoir, double gravity,
                          Unknowns &load);

  /** Westergaard's added mass 7/8 rho sqrt(H h) A n n^T on the nodes of the surface "upstream", as 3x3 blocks
   * in structure.mass and structure.added_mass; h: depth of the node, A n: its tributary area vector; H:
   * depth of the reservoir (global: at its deepest point; local: in the vertical section through the node,
   * Kuo 1982). Returns the total added mass for horizontal motion along x [kg]. */
  double add_westergaard_mass(const SolidModel &model, const ReservoirParameters &reservoir,
                              Structure &structure);

  /** Inertial load of a unit acceleration of the base along each axis: -M iota [N s^2/m]. */
  std::array<Unknowns, 3> inertial_loads(const Structure &structure);
} // namespace Voussoir

#endif
