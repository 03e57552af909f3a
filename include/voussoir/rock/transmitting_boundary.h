// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_transmitting_boundary_h
#define voussoir_transmitting_boundary_h

#include <voussoir/rock/artificial_boundary.h>
#include <voussoir/rock/transmitting_formula.h>

namespace Voussoir
{
  /** Motion of the boundary nodes from that of the lines: u_b = u_ff + sum of weights times the scattered
   * field u - u_ff of the last steps. Knows only the lines; the scattered field is at rest at first. */
  class TransmittingBoundary : public ArtificialBoundary
  {
  public:
    explicit TransmittingBoundary(TransmittingFormula formula);

    /** Returns 6 for orders up to 3, and 2 N + 1 for a higher order N: one more than each line has. */
    unsigned int n_layers() const override;

    /** InputError for Gauss points near the boundary, which explode, and for a high Poisson's ratio without
     * enough damping, which grows (doc/boundary.md). */
    void check(const RockRegionParameters &parameters, double critical_time_step) const override;

    /** Gauss points near it (for orders 3 and 4 anywhere: a large box explodes), or no term against drift. */
    std::string warning(const RockRegionParameters &parameters) const override;

    /** InputError if a line has too few nodes, or if the fastest artificial wave crosses more than one
     * cell in a step, S = c dt / dx > 1. */
    void attach(const RockModel &model, const Vector3 &centre, double dt) override;

    const std::vector<unsigned int> &nodes() const override { return boundary_node; }

    /** Nodes of all lines, line after line. */
    const std::vector<unsigned int> &free_field_nodes() const override { return node; }
    unsigned int                     nodes_per_line() const override { return n_points; }

    /** Orders 3 and 4 were seen to explode with prescribed nodes on a line. */
    void check_prescribed(const std::vector<unsigned int> &prescribed) const override;

    void start(const RegionStep &step) override { advance(step); }
    void advance(const RegionStep &step) override;

    void keep(const std::vector<bool> &stepped) override { kept = stepped_of(boundary_node, stepped); }
    std::vector<unsigned int> kept_points() const override;
    std::vector<unsigned int> nodes_of_points() const override;

    std::vector<std::vector<double> *> state() override;

    const TransmittingFormula &transmitting_formula() const { return formula; }

  private:
    /** @p known: n_points where the compiler may know it, or 0. */
    template <unsigned int known> void move_nodes(const RegionStep &step);

    TransmittingFormula       formula;
    unsigned int              n_points;            ///< per line
    std::vector<unsigned int> boundary_node, node; ///< of each line the first, and all
    std::vector<unsigned int> kept;                ///< lines
    std::vector<double>       weights;             ///< by line, step back and point
    std::vector<Unknowns>     history;             ///< scattered field of all nodes, the latest first
  };
} // namespace Voussoir

#endif
