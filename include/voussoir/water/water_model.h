// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_water_model_h
#define voussoir_water_model_h

#include <voussoir/water/water_section.h>

namespace Voussoir
{
  /** Properties of compressible water. */
  struct WaterProperties
  {
    double density;     ///< [kg/m^3]
    double sound_speed; ///< [m/s]
    double reflection;  ///< reflection coefficient of bed and banks [-]
    double depth;       ///< largest depth H [m]
    double length;      ///< of the part without damping upstream of the dam [m]
    double h;           ///< size of the elements at the dam [m]
  };

  /** Finite elements of compressible water in a channel upstream of the wet face, for the velocity potential phi:
   *
   *     M phi'' + C phi' + K phi = rho a.v
   *
   * Elements have 8 nodes and 2x2x2 Gauss points, the masses are lumped. The section of the channel is that of the wet
   * face. Behind the length L a layer with growing damping follows, C_i = (c/H) xi^2 M_i with xi from 0 to 1, and a
   * dashpot. phi is zero at the water surface. Node j of the section in layer k has the number k n_section + j; layer 0
   * is at the dam. */
  class WaterModel
  {
  public:
    /** Assembles the matrices.
     * @param section mesh of the section
     * @param properties water
     * @param dt time step [s]; 0: none. The mass of elements with a critical time step below 1.02 dt is increased. */
    WaterModel(const WaterSection &section, const WaterProperties &properties, double dt);

    unsigned int n_nodes() const { return static_cast<unsigned int>(mass.size()); }

    /** Computes K times phi [kg m/s^2]. */
    void multiply(const std::vector<double> &phi, std::vector<double> &K_phi) const;

    /** Solves K phi = source with phi = 0 at the surface. Throws ComputationError if the iteration does not
     * converge. */
    std::vector<double> solve(const std::vector<double> &source) const;

    std::vector<Vector3> points;          ///< [m]
    std::vector<double>  mass;            ///< M [kg s^2/m^2], with the increase for the time step
    std::vector<double>  bed_damping;     ///< C by absorption at bed and banks [kg s/m^2]
    std::vector<double>  end_damping;     ///< C by damping layer and dashpot [kg s/m^2]
    std::vector<Vector3> ground;          ///< areas of bed and banks, normal out of the water [m^2]
    std::vector<bool>    at_surface;      ///< phi is zero
    unsigned int         n_section = 0;   ///< nodes of the section
    double               volume = 0.;     ///< [m^3]
    double               mass_factor = 1; ///< all mass, relative to the mass without increase [-]
    double               critical_step;   ///< lower bound, without increase of the mass [s]

  private:
    void                        add_layers(const WaterSection &section, const WaterProperties &properties);
    void                        make_pattern(const WaterSection &section);
    std::array<unsigned int, 8> nodes_of(std::size_t layer, const std::array<unsigned int, 4> &cell) const;
    void assemble_cells(const WaterSection &section, const WaterProperties &properties, double dt);
    void add_boundaries(const WaterSection &section, const WaterProperties &properties);

    std::vector<double>       layers; ///< distances of the layers from the dam, relative to the length [-]
    unsigned int              first_damped = 0;
    std::vector<std::size_t>  start; ///< rows of K
    std::vector<unsigned int> column;
    std::vector<double>       value;
  };
} // namespace Voussoir

#endif
