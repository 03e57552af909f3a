// SPDX-License-Identifier: GPL-3.0-or-later
// The weights of the transmitting formulas on an even and on an uneven line.

#include <voussoir/rock/transmitting_formula.h>

#include <cstdio>
#include <utility>

int main()
{
  using namespace Voussoir;
  const double c_p = 3200., c_s = 1900., dt = .002, r = 400.;
  for (const double growth : {1., 1.1})
    for (const auto &[name, formula] : {std::pair<const char *, TransmittingFormula>{"mtf1", mtf1()},
                                        {"mtf2-plain", mtf2_plain()},
                                        {"mtf2", mtf2()},
                                        {"mtf3", mtf3()},
                                        {"mtf4", mtf4()}})
    {
      std::vector<double> position = {0.}, courant, gamma;
      for (double h = 10.; position.size() < formula.n_nodes(); h *= growth)
        position.push_back(position.back() + h);
      for (const TransmittingFactor &factor : formula.factors)
      {
        courant.push_back((factor.p * c_p + factor.s * c_s) * dt);
        gamma.push_back((factor.gamma_p * c_p + factor.gamma_s * c_s) * dt / r);
      }
      std::printf("%s, cells grow by %.2f\n", name, growth);
      const auto weights = transmitting_weights(courant, gamma, position, formula.interpolation);
      for (std::size_t back = 0; back < weights.size(); ++back)
      {
        std::printf("  %zu back:", back);
        for (const double weight : weights[back])
          std::printf(" %.12f", weight);
        std::printf("\n");
      }
    }
}
