// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_free_field_h
#define voussoir_free_field_h

#include <voussoir/rock/explicit_region.h>
#include <voussoir/rock/free_field_column.h>
#include <voussoir/rock/rock_model.h>

#include <memory>

namespace Voussoir
{
  /** The motion of the ground without dam and topography, in lock-step with the region: columns, and sections
   * through the valley (extruded slices of the mesh, themselves regions with columns at their sides). */
  class FreeField : public IncidentField
  {
  public:
    /** Columns of the side faces of @p model, and for its bottom the column with the highest top. */
    FreeField(const RockModel &model, const RayleighDamping &damping, double dt, unsigned int n_steps,
              const IncidentWave &wave);
    ~FreeField() override;

    /** Points of all lines that agree in place with nodes of the section, but for @p direction (0 = x,
     * 1 = y), take its motion. Before the points are added. */
    void add_section(RockModel section, std::unique_ptr<ExplicitRegion> region, unsigned int direction);

    /** The first @p n nodes of every line become points; returns nothing, the order is that of the lines. */
    void add_lines(const RockModel &model, unsigned int n);

    /** These nodes become points. Nodes of lines move like their line. */
    void add_nodes(const RockModel &model, const std::vector<unsigned int> &nodes);

    /** With several ranks: each steps its share of the columns, asks for these points only, and for the
     * columns that they follow. To be called by all at once. */
    void split_up(std::vector<unsigned int> points);

    void begin_step(std::vector<Ranks::Message> &messages) override;
    void end_step() override;
    void evaluate(Unknowns &u) const override;

    unsigned int n_columns() const { return static_cast<unsigned int>(columns.size()); }

    std::vector<std::vector<double> *> state() override;
    void                               collect() override;

  private:
    struct Section;
    struct Point
    {
      const double         *value[4]; ///< three components each
      std::array<double, 4> weight;
      unsigned int          column = no_node; ///< that it follows, if any
    };

    /** Columns that this rank steps for another one, and that one for this. */
    struct Partner
    {
      unsigned int              rank;
      std::vector<unsigned int> give, take;
      std::vector<double>       out, in; ///< their displacements
    };

    void  find_partners();
    Point in_column(unsigned int column, double z) const;
    bool  in_section(const std::array<double, 3> &place, Point &point) const;
    Point of_line(const RockModel &model, unsigned int line, unsigned int k) const;

    std::vector<std::unique_ptr<FreeFieldColumn>> columns;
    std::vector<unsigned int>                     number; ///< of the model's columns, among those that differ
    unsigned int                                  highest = 0;
    std::vector<std::unique_ptr<Section>>         sections;
    std::vector<Point>                            points;
    std::vector<unsigned int>                     kept; ///< of them
    bool                                          is_split = false;
    Shares                                        share; ///< of the columns, if split
    std::vector<Partner>                          partners;
  };
} // namespace Voussoir

#endif
