// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_transmitting_boundary_h
#define voussoir_transmitting_boundary_h

#include <voussoir/rock/artificial_boundary.h>
#include <voussoir/rock/transmitting_formula.h>

namespace Voussoir
{
  /** Transmitting boundary. The displacement of a boundary node is u_b = u_ff + sum of weights times the
   * scattered field u - u_ff of the last steps, at the nodes of its line. It depends on the lines of the
   * model only. The scattered field is zero at the start. */
  class TransmittingBoundary : public ArtificialBoundary
  {
  public:
    /** Creates a boundary with the given formula; see mtf1() to mtf4(). */
    explicit TransmittingBoundary(TransmittingFormula formula);

    /** Returns 6 for orders up to 3, and 2 N + 1 for a higher order N: one more than each line has. */
    unsigned int n_layers() const override;

    /** Throws InputError for Gauss points near the boundary, which are unstable (doc/boundary.md). */
    void check(const RockRegionParameters &parameters) const override;

    /** Returns a warning for Gauss points near the boundary (orders 3 and 4: anywhere, since large boxes are
     * unstable), or for a formula without a term against drift. */
    std::string warning(const RockRegionParameters &parameters) const override;

    double largest_step(const RockModel &model) const override;

    /** Computes the weights of all lines. Throws InputError if a line has too few nodes, or if the fastest
     * artificial wave crosses more than one cell in a step: S = c dt / dx > 1. */
    void attach(const RockModel &model, const Vector3 &centre, double dt) override;

    const std::vector<unsigned int> &nodes() const override { return boundary_node; }

    /** Returns the nodes of all lines, line after line. */
    const std::vector<unsigned int> &free_field_nodes() const override { return node; }
    unsigned int                     nodes_per_line() const override { return n_points; }

    /** Throws InputError if a prescribed node lies on a line. Orders 3 and 4 were unstable in this case. */
    void check_prescribed(const std::vector<unsigned int> &prescribed) const override;

    void start(const RegionStep &step) override { advance(step); }
    void advance(const RegionStep &step) override;

    void keep(const std::vector<bool> &stepped) override { kept = stepped_of(boundary_node, stepped); }
    std::vector<unsigned int> kept_points() const override;
    std::vector<unsigned int> nodes_of_points() const override;

    std::vector<std::vector<double> *> state() override;

    const TransmittingFormula &transmitting_formula() const { return formula; }

  private:
    /** Computes the motion of the boundary nodes. Template argument: n_points as a constant for the compiler,
     * or 0. */
    template <unsigned int known> void move_nodes(const RegionStep &step);

    TransmittingFormula       formula;
    unsigned int              n_points;            ///< nodes per line
    std::vector<unsigned int> boundary_node, node; ///< first node of each line; all nodes of all lines
    std::vector<unsigned int> kept;                ///< lines that this process integrates
    std::vector<double>       weights;             ///< per line, step back and point
    std::vector<Unknowns>     history;             ///< scattered field of all nodes [m], the latest first
  };
} // namespace Voussoir

#endif
