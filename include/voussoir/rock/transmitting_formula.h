// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_transmitting_formula_h
#define voussoir_transmitting_formula_h

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

  TransmittingFormula mtf1();       ///< c_s, gamma c_s dt/r
  TransmittingFormula mtf2();       ///< c_p, c_s; gamma c_p dt/r and, fitted, 1.6 c_s dt/r
  TransmittingFormula mtf2_plain(); ///< 1.35 c_s twice, gamma = 0: it drifts
  TransmittingFormula mtf3();       ///< c_p, c_s, 1.35 c_s; gamma 1.35 c_s dt/r, one r for all lines
  TransmittingFormula mtf4();       ///< c_p, c_s, 0.92 c_s, 1.35 c_s; gamma like that of mtf3

  /** Weights of u_0 at t + dt: first index the steps back (from 0), second the node of the line.
   *
   * Expansion of prod_j (1 - g_j Z T_j), Z one step back, T_j the interpolation at c_j dt further inward,
   * g_j = 1/(1 + gamma_j). @p courant: c_j dt [m]; @p position: of the line's nodes [m]. */
  std::vector<std::vector<double>> transmitting_weights(const std::vector<double>         &courant,
                                                        const std::vector<double>         &gamma,
                                                        const std::vector<double>         &position,
                                                        TransmittingFormula::Interpolation rule);
} // namespace Voussoir

#endif
