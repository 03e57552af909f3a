#ifndef voussoir_free_field_h
#define voussoir_free_field_h

#include <voussoir/rock_model.h>

#include <functional>
#include <memory>

namespace Voussoir
{
  class ExplicitRegion;
  struct GroundMotion;

  /** Rayleigh damping of the rock: C = mass M + stiffness K [1/s], [s]. */
  struct RayleighDamping
  {
    double mass = 0., stiffness = 0.;
  };

  /** Displacement of the vertically rising wave at time t [m]: S in x and y, P in z. It is that of the depth
   * at which it enters, one cell below the lowest foot of the columns. */
  using IncidentWave = std::function<Vector3(double)>;

  /** Half the displacement that belongs to a motion of the free surface (outcrop): the exact integral of its
   * piecewise linear acceleration from rest. */
  IncidentWave incident_wave(const GroundMotion &outcrop);

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

  /** The motion of the ground without dam and topography, in lock-step with the region: columns, and sections
   * through the valley (extruded slices of the mesh, themselves regions with columns at their sides). */
  class FreeField
  {
  public:
    /** Columns of the side faces of @p model, and for its bottom the column with the highest top. */
    FreeField(const RockModel &model, const RayleighDamping &damping, double dt, unsigned int n_steps,
              const IncidentWave &wave);
    ~FreeField();

    /** Points of all lines that agree in place with nodes of the section, but for @p direction (0 = x,
     * 1 = y), take its motion. Before the points are added. */
    void add_section(RockModel section, std::unique_ptr<ExplicitRegion> region, unsigned int direction);

    /** The first @p n nodes of every line become points; returns nothing, the order is that of the lines. */
    void add_lines(const RockModel &model, unsigned int n);

    /** These nodes become points. Nodes of lines move like their line. */
    void add_nodes(const RockModel &model, const std::vector<unsigned int> &nodes);

    /** To the next time step. */
    void advance();

    /** Displacement of the points now, three values each [m]. */
    void evaluate(Unknowns &u) const;

    unsigned int n_columns() const { return static_cast<unsigned int>(columns.size()); }

    std::vector<std::vector<double> *> state();

  private:
    struct Section;
    struct Point
    {
      const double         *value[4]; ///< three components each
      std::array<double, 4> weight;
    };

    Point in_column(unsigned int column, double z) const;
    bool  in_section(const std::array<double, 3> &place, Point &point) const;
    Point of_line(const RockModel &model, unsigned int line, unsigned int k) const;

    std::vector<std::unique_ptr<FreeFieldColumn>> columns;
    std::vector<unsigned int>                     number; ///< of the model's columns, among those that differ
    unsigned int                                  highest = 0;
    std::vector<std::unique_ptr<Section>>         sections;
    std::vector<Point>                            points;
  };
} // namespace Voussoir

#endif
