// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_oblique_column_h
#define voussoir_oblique_column_h

#include <voussoir/rock/ground_column.h>
#include <voussoir/rock/incident_wave.h>
#include <voussoir/rock/plane_wave.h>
#include <voussoir/rock/rock_model.h>

#include <memory>

namespace Voussoir
{
  /** Discrete column of layered ground in which all fields have the form U(z, t - p s), with the horizontal
   * slowness p and the coordinate s along the horizontal direction of propagation. Derivatives along s are
   * -p times derivatives in time. With nodal quadrature the equations of the components u_s and u_z are
   *
   *   M_s u_s'' = -K_s u_s - G u_z',   M_z u_z'' = -K_z u_z + G' u_s',
   *
   * with the masses V (rho - p^2 (lambda + 2 mu)) and V (rho - p^2 mu). u_s lives at half steps and u_z at
   * whole steps, so the scheme is explicit, and stable below the critical time step. SH waves have one
   * component with the mass of u_z and the stiffness of u_s.
   *
   * The motion of the first node is prescribed, the last node is free. */
  class ObliqueLine
  {
  public:
    /** Properties of a cell between two nodes. */
    struct Cell
    {
      double   size; ///< [m]
      Material material;
    };

    /** Creates a line at rest. @p is_sh: one horizontal component, which takes the place of u_z. @p dt: time
     * step [s]. */
    ObliqueLine(const std::vector<Cell> &cells, double p, bool is_sh, const RockDamping &damping, double dt);

    /** Returns an upper bound of the circular frequencies of the cells [1/s]. */
    static double largest_frequency(const std::vector<Cell> &cells, double p, bool is_sh);

    void step_along(); ///< advances u_s of all nodes except the first by one step
    void step_rest();  ///< advances u_z likewise, after u_s of the first node is set
    /** Sets u_s of the first node at the new time [m]. */
    void set_along(const double value) { set(along_, value); }
    /** Sets u_z of the first node at the new time [m]. */
    void set_rest(const double value) { set(rest_, value); }

    double along(const std::size_t i) const { return along_.u[i]; } ///< u_s of a node [m]
    double rest(const std::size_t i) const { return rest_.u[i]; }   ///< u_z of a node [m]

    std::vector<std::vector<double> *> state() { return {&along_.u, &along_.w, &rest_.u, &rest_.w}; }

  private:
    /** One component of the motion. */
    struct Component
    {
      std::vector<double> u, w;      ///< displacement, and velocity half a step later [m, m/s]
      std::vector<double> mass;      ///< per node and area, reduced by the slowness [kg/m^2]
      std::vector<double> stiffness; ///< per cell and area [N/m^3]
    };

    /** Advances a component by one step. @p sense: sign of G_own in its equation. */
    void step(Component &moved, const Component &other, double sense);
    void set(Component &component, double value) const;

    double              dt;
    RockDamping         damping;
    Component           along_, rest_;  ///< u_s; u_z or the component of SH
    std::vector<double> mass;           ///< per node and area, not reduced [kg/m^2]
    std::vector<double> G_own, G_other; ///< per cell: p (lambda - mu)/2, p (lambda + mu)/2
    std::vector<double> next;           ///< velocities in a step [m/s]
  };

  /** Motion of layered ground under plane waves that rise at an angle. The total motion of a flat region
   * equals it up to the error of the elements along the ground. Each wave has a column of its own, with
   * uniform half-spaces above the entrance for the incident wave and below the lowest node for the leaving
   * one, as in FreeFieldColumn. */
  class ObliqueColumn : public GroundColumn
  {
  public:
    /** Creates a column at rest.
     * @param incidence waves; their delays count from the start of ColumnRun::wave
     * @param half_space rock that the angles refer to
     * @param box opposite corners of the box of all places of displacement() [m]
     *
     * Throws InputError for waves that do not propagate in the column. */
    ObliqueColumn(const RockColumn &column, const ColumnRun &run, const Incidence &incidence,
                  const Material &half_space, const std::pair<Vector3, Vector3> &box);
    ~ObliqueColumn() override;

    void    advance() override;
    Vector3 displacement(int level, const Vector3 &place, double later) const override;

    std::vector<double> &motion() override { return latest; }
    void                 received() override;

    std::vector<std::vector<double> *> state() override;

  private:
    struct Part;
    std::vector<std::unique_ptr<Part>> parts;  ///< one per wave
    std::vector<double>                latest; ///< motion of all waves in the current step [m]
  };
} // namespace Voussoir

#endif
