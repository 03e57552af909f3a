// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_transmitting_formula_h
#define voussoir_transmitting_formula_h

#include <vector>

namespace Voussoir
{
  /** Factor ((1 + gamma) - B) of a transmitting formula. Its artificial wave speed is p c_p + s c_s. The term
   * gamma = (gamma_p c_p + gamma_s c_s) dt / r describes geometric spreading and prevents drift
   * of the boundary. */
  struct TransmittingFactor
  {
    double p = 0., s = 0., gamma_p = 0., gamma_s = 0.;
  };

  /** Multi-Transmitting Formula (Liao and Wong 1984). Its order is the number of its factors. */
  struct TransmittingFormula
  {
    /** Interpolation of the displacement between the nodes of a line. */
    enum class Interpolation
    {
      quadratic, ///< composed: the point 2 c dt from two steps of c dt
      linear,    ///< composed, linear
      direct     ///< three nodes around the point; of first order only, for comparison
    };
    std::vector<TransmittingFactor> factors;
    Interpolation                   interpolation = Interpolation::quadratic;
    bool uniform_distance = false; ///< true: r is the smallest distance of all lines; false: of each line

    /** Returns the order of the formula. */
    unsigned int order() const { return static_cast<unsigned int>(factors.size()); }

    /** Returns the number of nodes that a line requires: 2 order + 1. */
    unsigned int n_nodes() const { return 2 * order() + 1; }
  };

  TransmittingFormula mtf1();       ///< speed c_s; gamma = c_s dt/r
  TransmittingFormula mtf2();       ///< speeds c_p, c_s; gamma = c_p dt/r and, fitted, 1.6 c_s dt/r
  TransmittingFormula mtf2_plain(); ///< speed 1.35 c_s twice, gamma = 0: drifts
  TransmittingFormula mtf3(); ///< speeds c_p, c_s, 1.35 c_s; gamma = 1.35 c_s dt/r with one r for all lines
  TransmittingFormula mtf4(); ///< speeds c_p, c_s, 0.92 c_s, 1.35 c_s; gamma as for mtf3()

  /** Returns the weights of the displacement of the boundary node at t + dt. The first index is the number of
   * steps back (from 0), the second the node of the line.
   * @param courant distances c_j dt of the factors [m]
   * @param gamma geometric spreading of the factors [-]
   * @param position distances of the nodes from the boundary [m]
   * @param rule interpolation
   *
   * The weights follow from the expansion of prod_j (1 - g_j Z T_j). Z is one step back, T_j the
   * interpolation c_j dt further inward, and g_j = 1/(1 + gamma_j). */
  std::vector<std::vector<double>> transmitting_weights(const std::vector<double>         &courant,
                                                        const std::vector<double>         &gamma,
                                                        const std::vector<double>         &position,
                                                        TransmittingFormula::Interpolation rule);
} // namespace Voussoir

#endif
