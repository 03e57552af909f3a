// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_free_field_column_h
#define voussoir_free_field_column_h

#include <voussoir/rock/incident_wave.h>
#include <voussoir/rock/rock_model.h>

namespace Voussoir
{
  /** Of waves that rise, in x, y, z: S, S, P [m/s]. */
  Vector3 wave_speeds(const Material &material);

  /** Uniform half-space of 1-D cells, driven at its first node and endless: it is long enough for the waves
   * not to come back within the steps it was made for. Explicit, like the region. */
  class EndlessColumn
  {
  public:
    /** @p courant: c dt/h of the three components. */
    EndlessColumn(const Vector3 &courant, const RayleighDamping &damping, double dt, unsigned int n_steps);

    /** Displacement of the second node at t + dt, given that of the first at t. */
    const Vector3 &advance(const Vector3 &first);

    std::vector<std::vector<double> *> state() { return {&u, &w}; }

  private:
    RayleighDamping     damping;
    double              dt;
    Vector3             ratio;
    std::vector<double> u, w; ///< displacement at t and velocity half a step before [m, m/s], node after node
    std::vector<double> x;    ///< displacement with the stress of damping added
    Vector3             second;
  };

  /** Motion of horizontally layered ground: the discrete column, which total motion of a flat region follows
   * to round-off. Below its foot the ground goes on as its lowest cell. */
  class FreeFieldColumn
  {
  public:
    /** @p delay: of S in x and y, P in z, until the wave enters here [s]. */
    FreeFieldColumn(const RockColumn &column, const RayleighDamping &damping, double dt, unsigned int n_steps,
                    const IncidentWave &wave, const Vector3 &delay);

    void advance();

    const std::vector<double> &z() const { return height; }
    const double              *displacement(const unsigned int level) const { return &u[3 * level]; }
    std::vector<double>       &motion() { return u; } ///< of all levels, three components each [m]

    std::vector<std::vector<double> *> state();

  private:
    Vector3 incident(double t) const;

    std::vector<double> height, mass, stiffness; ///< per area: of the nodes; of the cells, three components
    RayleighDamping     damping;
    double              dt;
    IncidentWave        wave;
    Vector3             delay, foot_stiffness;
    EndlessColumn rising, leaving; ///< incident wave above where it enters; what goes down below the foot
    std::vector<double> u, w, x;
    std::vector<double>
        below; ///< incident wave one cell below and at the foot, wave that leaves, and the former two before
    std::vector<double> time; ///< [s], one value
  };
} // namespace Voussoir

#endif
