// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_free_field_h
#define voussoir_free_field_h

#include <voussoir/rock/ground_column.h>
#include <voussoir/rock/incident_field.h>
#include <voussoir/rock/incident_wave.h>
#include <voussoir/rock/plane_wave.h>
#include <voussoir/rock/rock_model.h>
#include <voussoir/rock/section_motion.h>

#include <memory>

namespace Voussoir
{
  /** Free-field motion: motion of the ground without dam and topography, integrated in step with the region.
   * It consists of columns of layered ground and of sections through the valley. A section is an extruded
   * slice of the mesh, with a motion of its own. Its motions for waves of different slownesses are added. */
  class FreeField : public IncidentField
  {
  public:
    /** Creates the columns of the side faces of @p model. The bottom follows the column with the highest top.
     * @param model rock model with at least one column
     * @param damping Rayleigh damping of the rock
     * @param dt time step of the rock [s]
     * @param n_steps largest number of steps of the run
     * @param wave incident wave
     * @param incidence directions of the waves
     *
     * Throws InputError if the artificial boundary has no bottom, and for waves that do not propagate in the
     * rock. */
    FreeField(const RockModel &model, const RockDamping &damping, double dt, unsigned int n_steps,
              const IncidentWave &wave, const Incidence &incidence = {});
    ~FreeField() override;

    /** Adds a section normal to @p direction (0: x, 1: y). Points at which SectionNodes finds nodes take their
     * motion; all points of a line, or none. Call it before points are added. @p rock: model of the rock. */
    void add_section(const RockModel &section, const RockModel &rock,
                     std::vector<std::unique_ptr<SectionMotion>> motions, unsigned int direction);

    /** Adds the first @p n nodes of every line as points, line after line. */
    void add_lines(const RockModel &model, unsigned int n);

    /** Adds the first node of a line as a point at the given place or, if @p is_below, the place one cell
     * below the lowest node of its column. */
    void add_end_of_line(const RockModel &model, unsigned int line, const Vector3 &place, bool is_below);

    /** Adds the given nodes as points. Nodes of lines move like their line. */
    void add_nodes(const RockModel &model, const std::vector<unsigned int> &nodes);

    /** Distributes the columns over the MPI processes. All processes must call it. @p points: indices of the
     * points that this process requires. */
    void split_up(std::vector<unsigned int> points);

    /** Begins a step; see IncidentField::begin_step(). */
    void begin_step(std::vector<Ranks::Message> &messages) override;
    void end_step() override;
    void evaluate(Unknowns &u) const override { evaluate(u, 0.); }

    /** Stores the displacement of the points in @p u at a time after the current one, from -1 to 1 steps
     * [s]. Other times than the current one are for oblique waves, and for points without a section. */
    void evaluate(Unknowns &u, double later) const;

    /** Returns the current displacement of the ground at places of the valley upstream, three values per
     * place [m]. The nearest node of the section with the smallest x is used; without sections, the highest
     * column. All places have the delay of Incidence::centre along the valley.
     * @p places: the same in all calls; the x coordinate does not count. Not after split_up(). */
    Unknowns upstream(const std::vector<Vector3> &places);

    unsigned int n_columns() const { return static_cast<unsigned int>(grounds.size()); }

    std::vector<std::vector<double> *> state() override;
    void                               gather_on_root() override;

  private:
    struct Section;
    struct Point
    {
      const Section        *section = nullptr;        ///< section that the point follows, or null
      unsigned int          column = no_node;         ///< column that the point follows, or no_node
      std::array<int, 4>    level{};                  ///< of the column, or nodes of the section
      std::array<double, 4> weight{{1., 0., 0., 0.}}; ///< per level
      Vector3               place{};                  ///< [m]
    };

    /** Columns exchanged with another process: this process integrates give, the other one take. */
    struct Partner
    {
      unsigned int              rank;
      std::vector<unsigned int> give, take;
      std::vector<double>       out, in; ///< displacements of the columns [m]
    };

    void    find_partners();
    Point   in_column(unsigned int column, const Vector3 &place);
    Point   at_level(unsigned int column, int level, const Vector3 &place);
    Vector3 displacement(const Point &point, double later = 0.) const;
    bool    in_section(const Vector3 &place, Point &point) const;
    Point   of_line(const RockModel &model, unsigned int line, const Vector3 &place);

    Vector3 centre; ///< Incidence::centre

    /** Creates a column of the model at rest. */
    std::function<std::unique_ptr<GroundColumn>(const RockColumn &)> make_column;

    std::vector<RockColumn>                    grounds; ///< different columns of the model
    std::vector<std::unique_ptr<GroundColumn>> columns; ///< per ground; null if no point follows it
    std::vector<unsigned int>             number; ///< per column of the model: index of its equal in columns
    unsigned int                          highest = 0;
    std::vector<std::unique_ptr<Section>> sections;
    std::vector<Point>                    points;
    std::vector<unsigned int>             upstream_nodes; ///< of the section upstream: upstream()
    std::vector<unsigned int>             kept; ///< indices of the points that this process requires
    bool                                  is_split = false;
    Shares                                share; ///< distribution of the columns, if is_split
    std::vector<Partner>                  partners;
  };
} // namespace Voussoir

#endif
