// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_water_model_h
#define voussoir_water_model_h

#include <voussoir/water/water_section.h>

#include <complex>

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

    /** Returns the model of the far channel: one straight layer, as long as the last one of this model, with free
     * ends. If bed and banks have the same motion on both sides of the layer, phi does not depend on x. */
    WaterModel far_channel(WaterSection section, const WaterProperties &properties, double dt) const;

    unsigned int n_nodes() const { return static_cast<unsigned int>(mass.size()); }

    /** Computes K times phi [kg m/s^2]. Number: double or std::complex<double>. */
    template <class Number> void multiply(const std::vector<Number> &phi, std::vector<Number> &K_phi) const;

    /** Solves K phi = source with phi = 0 at the surface. Throws ComputationError if the iteration does not
     * converge. */
    std::vector<double> solve(const std::vector<double> &source) const;

    /** Solves (K + s C + s^2 M) phi = source with phi = 0 at the surface, by conjugate gradients for complex symmetric
     * matrices. @p s: complex circular frequency [1/s]. Throws ComputationError if the iteration does not converge. */
    std::vector<std::complex<double>> solve(std::complex<double>                     s,
                                            const std::vector<std::complex<double>> &source) const;

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
    explicit WaterModel(unsigned int n_section) : n_section(n_section) {}
    void                        place_nodes(const WaterSection &section, double length);
    void                        add_layers(const WaterSection &section, const WaterProperties &properties);
    void                        make_pattern(const WaterSection &section);
    std::array<unsigned int, 8> nodes_of(std::size_t layer, const std::array<unsigned int, 4> &cell) const;
    void assemble_cells(const WaterSection &section, const WaterProperties &properties, double dt);
    void add_bed(const WaterSection &section, const WaterProperties &properties);
    void add_end(const WaterSection &section, const WaterProperties &properties);

    template <class Number>
    std::vector<Number> solve_diagonal_plus(const std::vector<Number> &diagonal,
                                            std::vector<Number>        source) const;

    std::vector<double>       layers; ///< distances of the layers from the dam, relative to the length [-]
    double                    last_length = 0.; ///< of the last layer [m]
    unsigned int              first_damped = 0;
    std::vector<std::size_t>  start; ///< rows of K
    std::vector<unsigned int> column;
    std::vector<double>       value;
  };
} // namespace Voussoir

#endif
