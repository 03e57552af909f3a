#ifndef voussoir_transmitting_boundary_h
#define voussoir_transmitting_boundary_h

#include <voussoir/rock/rock_model.h>

#include <string>
#include <vector>

namespace Voussoir
{
  /** One factor ((1 + gamma) - B) of a transmitting formula. Its artificial speed is p c_p + s c_s; gamma,
   * the term of geometric spreading that keeps the boundary from drifting, is
   * (gamma_p c_p + gamma_s c_s) dt / r. */
  struct TransmittingFactor
  {
    double p = 0., s = 0., gamma_p = 0., gamma_s = 0.;
  };

  /** Multi-transmitting formula (Liao and Wong 1984), of an order for each factor. */
  struct TransmittingFormula
  {
    enum class Interpolation
    {
      quadratic, ///< composed: the point 2 c dt by two steps of c dt
      linear,    ///< composed
      direct     ///< three nodes about the point itself; of first order only, kept to show that
    };
    std::vector<TransmittingFactor> factors;
    Interpolation                   interpolation = Interpolation::quadratic;
    bool uniform_distance = false; ///< r is the smallest distance of all lines, or each line's own

    unsigned int order() const { return static_cast<unsigned int>(factors.size()); }

    /** Nodes that a line needs: 2 order + 1. */
    unsigned int n_nodes() const { return 2 * order() + 1; }
  };

  /** "mtf1" (c_s), "mtf2" (c_p, c_s; gamma c_p dt/r and, fitted, 1.6 c_s dt/r), "mtf3" (c_p, c_s, 1.35 c_s),
   * "mtf4" (c_p, c_s, 0.92 c_s, 1.35 c_s), these two with gamma 1.35 c_s dt/r and one r for all lines,
   * "mtf2-plain" (1.35 c_s twice, gamma = 0: it drifts), and "fixed", which has no factor: the boundary moves
   * with the free field. InputError for other names. */
  TransmittingFormula transmitting_formula(const std::string &name);

  /** Weights of u_0 at t + dt: first index the steps back (from 0), second the node of the line.
   *
   * Expansion of prod_j (1 - g_j Z T_j), Z one step back, T_j the interpolation at c_j dt further inward,
   * g_j = 1/(1 + gamma_j). @p courant: c_j dt [m]; @p position: of the line's nodes [m]. */
  std::vector<std::vector<double>> transmitting_weights(const std::vector<double>         &courant,
                                                        const std::vector<double>         &gamma,
                                                        const std::vector<double>         &position,
                                                        TransmittingFormula::Interpolation rule);

  /** Motion of the boundary nodes from that of the lines: u_b = u_ff + sum of weights times the scattered
   * field u - u_ff of the last steps. Knows only the lines; the scattered field is at rest at first. */
  class TransmittingBoundary
  {
  public:
    /** InputError if a line has too few nodes, or if the fastest artificial wave crosses more than one
     * cell in a step, S = c dt / dx > 1. */
    TransmittingBoundary(const TransmittingFormula &formula, const std::vector<BoundaryLine> &lines,
                         double dt);

    unsigned int n_lines() const { return static_cast<unsigned int>(node.size() / n_points); }

    /** Boundary node of a line. */
    unsigned int boundary_node(const unsigned int line) const { return node[std::size_t(line) * n_points]; }

    /** Nodes of all lines, line after line, nodes_per_line() each: where the free field is to be known. */
    const std::vector<unsigned int> &nodes() const { return node; }
    unsigned int                     nodes_per_line() const { return n_points; }

    /** Displacement of the boundary nodes at t + dt [m], three values per line.
     * @p u: of all nodes of the region at t; @p free_field: at t, and @p next_free_field: at t + dt, three
     * values for each of nodes(); both empty without an incident wave. */
    const Unknowns &advance(const Unknowns &u, const Unknowns &free_field, const Unknowns &next_free_field);

    /** All that it remembers, for checkpoints. */
    std::vector<std::vector<double> *> state();

  private:
    unsigned int              n_points; ///< per line
    std::vector<unsigned int> node;
    std::vector<double>       weights; ///< by line, step back and point
    std::vector<Unknowns>     history; ///< scattered field of nodes(), the latest first
    Unknowns                  next;
  };

  /** InputError if one of the @p prescribed nodes, out of @p n_nodes of the region, lies on a line of the
   * boundary: orders 3 and 4 were seen to explode with such. */
  void check_distance(const TransmittingBoundary &boundary, const std::vector<unsigned int> &prescribed,
                      unsigned int n_nodes);

} // namespace Voussoir

#endif
