// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_water_model_h
#define voussoir_water_model_h

#include <voussoir/water/water_mesh.h>

#include <complex>

namespace Voussoir
{
  /** Finite elements of compressible water for the velocity potential phi:
   *
   *     M phi'' + C phi' + K phi = rho a.v
   *
   * Elements have 8 nodes and 2x2x2 Gauss points, the masses are lumped. The damping layer has C_i = (c/H) xi^2 M_i with
   * xi of WaterMesh::layer, the end a dashpot. phi is zero at the water surface. */
  class WaterModel
  {
  public:
    /** Assembles the matrices.
     * @param mesh nodes, elements and outer faces
     * @param properties water
     * @param dt time step [s]; 0: none. The mass of elements with a critical time step below 1.02 dt is increased. */
    WaterModel(const WaterMesh &mesh, const WaterProperties &properties, double dt);

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

    const double         density;         ///< [kg/m^3]
    std::vector<double>  mass;            ///< M [kg s^2/m^2], with the increase for the time step
    std::vector<double>  bed_damping;     ///< C by absorption at bed and banks [kg s/m^2]
    std::vector<double>  end_damping;     ///< C by damping layer and dashpot [kg s/m^2]
    std::vector<Vector3> ground;          ///< areas of bed and banks, normal out of the water [m^2]
    std::vector<bool>    at_surface;      ///< phi is zero
    double               volume = 0.;     ///< [m^3]
    double               mass_factor = 1; ///< all mass, relative to the mass without increase [-]
    double               critical_step;   ///< lower bound, without increase of the mass [s]

  private:
    void make_pattern(const WaterMesh &mesh);
    void assemble_cells(const WaterMesh &mesh, const WaterProperties &properties, double dt);
    void add_bed(const WaterMesh &mesh, const WaterProperties &properties);
    void add_end(const WaterMesh &mesh, const WaterProperties &properties);

    template <class Number>
    std::vector<Number> solve_diagonal_plus(const std::vector<Number> &diagonal,
                                            std::vector<Number>        source) const;

    std::vector<std::size_t>  start; ///< rows of K
    std::vector<unsigned int> column;
    std::vector<double>       value;
  };
} // namespace Voussoir

#endif
