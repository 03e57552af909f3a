// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_acoustic_water_h
#define voussoir_acoustic_water_h

#include <voussoir/foundation/base_motion.h>
#include <voussoir/foundation/foundation.h>
#include <voussoir/water/pressure_point.h>
#include <voussoir/water/water_coupling.h>

#include <memory>

namespace Voussoir
{
  /** Compressible water upstream of the dam, with explicit time integration: the pressure divided by the density,
   * pi = dphi/dt, at whole steps, the potential phi at half steps. Bed, banks and wet face move with the ground.
   *
   * In a step from n to n + 1, with D = M/dt + C/2 and the mean ground velocity v_g,
   *
   *     D pi_hat = (M/dt - C/2) pi_n - K phi_n+1/2 + rho b.v_g
   *     dam: nodal forces -rho A pi_n at the start, -rho A pi_n+1 at the end of the step, where
   *     pi_n+1 = pi_hat + rho A.(u_n+1 - u_n) / (dt D)
   *     phi_n+3/2 = phi_n+1/2 + dt pi_n+1
   *
   * pi_n+1 depends on the displacement of the dam: Body::reaction = rho^2 A A^T / (dt D). The scheme is stable for
   * time steps below the critical one of the water, and conserves energy. An explicit dam takes the same steps as the
   * water (StepNeighbour): the forces on its nodes are -rho A pi_n, and the critical step is that of both.
   *
   * Far upstream the motion does not depend on x. WaterMesh::far_channel() computes this motion, and the damping of
   * the end of the channel acts on the difference to it. Bed and banks have the same velocity v_g in all sections of
   * the channel: the ground motion, the motions of the banks (Motion/Abutments), or on rock with mass its free field
   * (BaseSupport::valley()). */
  class AcousticWater : public Neighbour, public StepNeighbour
  {
  public:
    /** Generates the mesh of a channel, or takes the water volumes of the mesh file.
     * @param dam model of the dam; must outlive the object
     * @param structure receives the reaction of the water at start(); must outlive the object
     * @param foundation moves bed and banks; must outlive the object
     * @param properties water; depth is computed
     * @param level water level [m]
     * @param volumes HexMesh::water, or null
     *
     * Throws InputError like WaterSection and read_volumes(), or if the volumes do not cover the wet face. */
    AcousticWater(const SolidModel &dam, Structure &structure, Foundation &foundation,
                  const WaterProperties &properties, double level, const HexMesh *volumes = nullptr);

    void   start(const GroundMotion &motion, const TimeGrid &grid, const Unknowns &u) override;
    void   advance(Unknowns &load) override;
    void   update_from_dam(const DynamicState &state) override;
    void   add_forces(Unknowns &load) const override;
    void   advance(const Unknowns &u, const Unknowns &w) override;
    double seconds() const override { return watch_total; }

    /** Returns the energy of the water, the energies radiated at the end of the channel and absorbed at bed and banks,
     * and the works of dam and ground on the water [J]. The radiated energy is negative if more energy enters with the
     * motion of the far water. */
    std::vector<std::pair<std::string, double>> energies() const override;
    double                                      balance_error() const override;
    void                                        report_balance(Log &log) const override;
    std::vector<std::vector<double> *>          state() override;

    /** Returns the finite elements for a time step [s]; 0: without increase of the mass. */
    WaterModel model_for(const double dt) const { return WaterModel(water_mesh, properties, dt); }

    const WaterMesh     &mesh() const { return water_mesh; }
    const WaterCoupling &with_dam() const { return coupling; }

    /** Returns the dynamic pressure at each water node at the dam [Pa]. */
    std::vector<double> pressure() const;

    /** Returns the middle of the wet face at a depth [m]. Throws InputError if the depth is too large. */
    PressurePoint point_at(double depth) const;

    /** Returns the value of the nearest water node at each node of the model of the dam; zero at dry nodes. @p values:
     * one per water node at the dam. */
    std::vector<double> at_dam(const std::vector<double> &values) const;

    /** Returns the mean force of the moving water in the last step on each node of the model of the dam [N], also on
     * fixed nodes. */
    std::vector<Vector3> mean_force() const;

    /** Returns the static pressure at a water node [Pa]. */
    double static_pressure(unsigned int node) const;

    /** Assembles the matrices for a time step [s]; 0: no earthquake. Must be called before report() and start(). Throws
     * InputError if the mass of the water must be increased by more than 30 %. @p steps_per_sample: entry of the input
     * file, for the message. @p n: steps of an explicit dam in the time step; 0: the dam is implicit. */
    void prepare(double dt, unsigned int steps_per_sample, unsigned int n = 0);

    /** Writes the properties to the log, and the places of point_at() for the @p depths [m]. */
    void report(Log &log, const std::vector<double> &depths) const;

    const double level;          ///< of the water [m]
    double       gravity = 9.81; ///< [m/s^2]

  private:
    std::string larger_elements() const;
    void        predict();
    void        correct(const Unknowns &u);
    void        find_bed_velocity();

    const SolidModel             &dam;
    Structure                    &structure;
    Foundation                   &foundation;
    WaterProperties               properties;
    WaterMesh                     water_mesh;
    WaterCoupling                 coupling;
    std::unique_ptr<WaterModel>   model;
    double                        dt = 0.;             ///< step of the water [s]
    unsigned int                  n_steps = 1;         ///< steps of the water in a step of the run
    unsigned int                  steps_of_valley = 1; ///< steps of the rock in a step of the water
    bool                          is_explicit = false; ///< the dam takes the steps of the water
    WaterMesh                     far_mesh;
    std::unique_ptr<WaterModel>   far;    ///< one layer of the far channel
    std::unique_ptr<BaseMotion>   banks;  ///< motion of the banks relative to the ground motion, or null
    std::unique_ptr<ValleyMotion> valley; ///< displacement of bed and banks, or null
    std::vector<Vector3>          ground_velocity; ///< per step [m/s]
    Vector3              base_velocity; ///< mean in the step of the axes of the dam's displacements [m/s]
    std::vector<Vector3> bed_velocity;  ///< per column of the mesh: mean in the step [m/s]
    std::vector<double>  D, inverse;    ///< [kg s/m^2] and its reciprocal
    std::vector<double>  far_inverse, far_pi, far_phi, far_mean; ///< as pi and phi; mean of pi in the step
    std::vector<double>  valley_place, valley_velocity; ///< last displacement [m] and mean velocity [m/s]
    std::vector<double>  pi, phi, K_phi, before;
    std::vector<double>  mean;   ///< of pi at the dam in the step of the run
    std::vector<double>  u_wet;  ///< displacement of the dam at the last step, 3 per wet dam node [m]
    std::vector<double>  record; ///< step, energies: see acoustic_water.cc
    double               watch_total = 0.;
  };
} // namespace Voussoir

#endif
