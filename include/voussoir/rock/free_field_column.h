// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_free_field_column_h
#define voussoir_free_field_column_h

#include <voussoir/rock/ground_column.h>
#include <voussoir/rock/incident_wave.h>
#include <voussoir/rock/rock_model.h>

namespace Voussoir
{
  /** Returns the speeds of vertically propagating waves with motion in x, y and z: S, S and P [m/s]. */
  Vector3 wave_speeds(const Material &material);

  /** Returns the number of cells of a uniform line from whose end no reflection returns to the beginning
   * within @p n_steps steps. @p courant: Courant numbers of its waves. */
  unsigned int endless_length(const Vector3 &courant, unsigned int n_steps);

  /** Uniform half-space of one-dimensional cells, driven at its first node. Its length is chosen so that no
   * reflection returns within the given number of steps. The integration is explicit, as in the region. */
  class EndlessColumn
  {
  public:
    /** Creates a half-space at rest for @p n_steps steps of @p dt [s]. @p courant: Courant numbers c dt/h of
     * the three components. */
    EndlessColumn(const Vector3 &courant, const RockDamping &damping, double dt, unsigned int n_steps);

    /** Advances by one step. @p first: displacement of the first node at t [m]. Returns the displacement of
     * the second node at t + dt [m]. */
    const Vector3 &advance(const Vector3 &first);

    /** Returns the state variables, for checkpoints. */
    std::vector<std::vector<double> *> state();

  private:
    RockDamping         damping;
    double              dt;
    DampedMotion        damped;
    Vector3             ratio;
    std::vector<double> u,
        w;                 ///< displacement at t, velocity half a step before [m, m/s], three values per node
    std::vector<double> x; ///< displacement with damping, see DampedMotion [m]
    Vector3             second;
  };

  /** Motion of horizontally layered ground in a discrete column. The total motion of a flat region equals it
   * up to round-off. Below the lowest node the ground continues with the properties of the lowest cell. */
  class FreeFieldColumn : public GroundColumn
  {
  public:
    /** Creates a column at rest. @p delay: travel time of the S (x, y) and P (z) waves until the wave enters
     * this column [s]. @p n_steps: largest number of steps of the run. */
    FreeFieldColumn(const RockColumn &column, const RockDamping &damping, double dt, unsigned int n_steps,
                    const IncidentWave &wave, const Vector3 &delay);

    void    advance() override;
    Vector3 displacement(int level, const Vector3 &place, double later) const override;

    std::vector<double> &motion() override
    {
      return u;
    } ///< displacement of all levels and one cell below [m]

    std::vector<std::vector<double> *> state() override;

  private:
    Vector3 incident(double t) const;

    std::vector<double> height, mass,
        stiffness; ///< per area: of the nodes; of the cells, three components each
    RockDamping   damping;
    double        dt;
    DampedMotion  damped, damped_below; ///< of the levels, and one cell below
    IncidentWave  wave;
    Vector3       delay, bottom_stiffness;
    EndlessColumn rising,
        leaving; ///< incident wave above its entrance; wave that leaves below the lowest node
    std::vector<double> u, w,
        x;                     ///< three values per node; the last three of u: one cell below the lowest node
    std::vector<double> below; ///< incident wave one cell below and at the lowest node, leaving wave;
                               ///< displacement one cell below in the previous step
    std::vector<double> time;  ///< [s], one value
  };
} // namespace Voussoir

#endif
