// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/rock/transmitting_formula.h>

#include <algorithm>

namespace Voussoir
{
  namespace
  {
    using Interpolation = TransmittingFormula::Interpolation;

    /** Returns Lagrange's weights of the nodes first ... first + n - 1 at @p x [m]. */
    std::vector<double> lagrange(const std::vector<double> &position, const unsigned int first,
                                 const unsigned int n, const double x)
    {
      std::vector<double> weight(n, 1.);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          if (i != j)
            weight[i] *= (x - position[first + j]) / (position[first + i] - position[first + j]);
      return weight;
    }

    /** Returns the @p weights shifted inward by @p step [m], by interpolation. */
    std::vector<double> shifted(const std::vector<double> &weights, const std::vector<double> &position,
                                const double step, const unsigned int n)
    {
      std::vector<double> result(position.size(), 0.);
      for (unsigned int k = 0; k < position.size(); ++k)
        if (weights[k] != 0.)
        {
          const unsigned int first = std::min<std::size_t>(k, position.size() - n);
          const auto         w = lagrange(position, first, n, position[k] + step);
          for (unsigned int i = 0; i < n; ++i)
            result[first + i] += weights[k] * w[i];
        }
      return result;
    }

    /** Returns the weights of the three nodes around the distance @p x from the boundary [m]. */
    std::vector<double> direct(const std::vector<double> &position, const double x)
    {
      unsigned int first = 0;
      while (first + 3 < position.size() && x > position[first + 2])
        ++first;
      std::vector<double> result(position.size(), 0.);
      const auto          w = lagrange(position, first, 3, x);
      std::copy(w.begin(), w.end(), result.begin() + first);
      return result;
    }

    /** Artificial wave speeds, divided by that of S waves: Rayleigh waves; between S and P. */
    constexpr double surface = .92, middle = 1.35;

    TransmittingFormula formula(const std::vector<TransmittingFactor> &factors)
    {
      TransmittingFormula result;
      result.factors = factors;
      result.uniform_distance = result.order() > 2;
      return result;
    }
  } // namespace

  TransmittingFormula mtf1()
  {
    return formula({{0., 1., 0., 1.}});
  }

  TransmittingFormula mtf2()
  {
    return formula({{1., 0., 1., 0.}, {0., 1., 0., 1.6}});
  }

  TransmittingFormula mtf2_plain()
  {
    return formula({{0., middle, 0., 0.}, {0., middle, 0., 0.}});
  }

  TransmittingFormula mtf3()
  {
    return formula({{1., 0., 0., middle}, {0., 1., 0., middle}, {0., middle, 0., middle}});
  }

  TransmittingFormula mtf4()
  {
    return formula(
        {{1., 0., 0., middle}, {0., 1., 0., middle}, {0., surface, 0., middle}, {0., middle, 0., middle}});
  }

  std::vector<std::vector<double>> transmitting_weights(const std::vector<double> &courant,
                                                        const std::vector<double> &gamma,
                                                        const std::vector<double> &position,
                                                        const Interpolation        rule)
  {
    const unsigned int               order = courant.size(), n = position.size();
    std::vector<std::vector<double>> weights(order, std::vector<double>(n, 0.));
    for (unsigned int subset = 1; subset < (1u << order); ++subset) // terms of the product
    {
      std::vector<double> term(n, 0.);
      term[0] = 1.;
      double       distance = 0., factor = -1.;
      unsigned int steps = 0;
      for (unsigned int j = 0; j < order; ++j)
        if (subset & (1u << j))
        {
          if (rule != Interpolation::direct)
            term = shifted(term, position, courant[j], rule == Interpolation::linear ? 2 : 3);
          distance += courant[j];
          factor *= -1. / (1. + gamma[j]);
          ++steps;
        }
      if (rule == Interpolation::direct)
        term = direct(position, distance);
      for (unsigned int k = 0; k < n; ++k)
        weights[steps - 1][k] += factor * term[k];
    }
    return weights;
  }
} // namespace Voussoir
