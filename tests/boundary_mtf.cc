// SPDX-License-Identifier: GPL-3.0-or-later
// Transmitting formula: its weights, and what it reflects in a bar, against the formula of the discrete
// problem. Liao and Wong 1984, Soil Dyn. Earthq. Eng. 3(4), 174-183.

#include "column.h"
#include "packet.h"

#include <voussoir/base/error.h>
#include <voussoir/rock/boundary_table.h>

#include <complex>

namespace
{
  using namespace Packets;
  using namespace std::complex_literals;
  using Columns::above;
  using Columns::below;
  using Complex = std::complex<double>;
  using Rule = TransmittingFormula::Interpolation;

  /** 1 - g Z T(kappa), quadratic. */
  Complex factor(const double courant, const double gamma, const Complex kappa, const Complex Z)
  {
    const double s = courant;
    const double t0 = (1. - s) * (2. - s) / 2., t1 = s * (2. - s), t2 = s * (s - 1.) / 2.;
    return 1. - Z / (1. + gamma) * (t0 + t1 * kappa + t2 * kappa * kappa);
  }

  std::vector<double> uniform(const unsigned int n)
  {
    std::vector<double> x(n);
    for (unsigned int k = 0; k < n; ++k)
      x[k] = k;
    return x;
  }

  void weights()
  {
    for (unsigned int order = 1; order <= 4; ++order)
    {
      const std::vector<double> all = {.5, .9, .3, .7}, gammas = {.01, 0., .05, .02};
      const std::vector<double> courant(all.begin(), all.begin() + order),
          gamma(gammas.begin(), gammas.begin() + order);
      const auto w = transmitting_weights(courant, gamma, uniform(2 * order + 1), Rule::quadratic);
      double     error = 0.;
      for (unsigned int sample = 0; sample < 20; ++sample)
      {
        const Complex kappa = std::exp(1i * (.3 * sample)), Z = std::exp(-1i * (.2 + .15 * sample));
        Complex       product = 1., sum = 1., back = 1.;
        for (unsigned int j = 0; j < order; ++j)
          product *= factor(courant[j], gamma[j], kappa, Z);
        for (unsigned int j = 0; j < order; ++j)
        {
          back *= Z;
          for (unsigned int k = 0; k < w[j].size(); ++k)
            sum -= back * w[j][k] * std::pow(kappa, k);
        }
        error = std::max(error, std::abs(sum - product));
      }
      below("weights of order " + std::to_string(order) + " - expanded product", error, 1e-13);
    }
    // Order 2 in full, S = 0.6, gamma = 0.02.
    const double S = .6, g = 1. / 1.02, a = (1 - S) * (2 - S) / 2, b = S * (2 - S), c = S * (S - 1) / 2;
    const auto   w = transmitting_weights({S, S}, {.02, .02}, uniform(5), Rule::quadratic);
    const double expected[2][5] = {{2 * g * a, 2 * g * b, 2 * g * c, 0, 0},
                                   {-g * g * a * a, -2 * g * g * a * b, -g * g * (2 * a * c + b * b),
                                    -2 * g * g * b * c, -g * g * c * c}};
    double       error = 0.;
    for (unsigned int j = 0; j < 2; ++j)
      for (unsigned int k = 0; k < 5; ++k)
        error = std::max(error, std::abs(w[j][k] - expected[j][k]));
    below("weights of order 2 - written out", error, 1e-14);
    // On a graded line a linear wave u = t + x/c passes exactly.
    const std::vector<double> graded = {0., 1., 2.1, 3.3, 4.7};
    const auto                v = transmitting_weights({.8, .8}, {0., 0.}, graded, Rule::quadratic);
    double                    u = 0.;
    for (unsigned int j = 0; j < 2; ++j)
      for (unsigned int k = 0; k < 5; ++k)
        u += v[j][k] * (-(j + 1.) + graded[k] / .8);
    below("graded line: error of a linear wave", u, 1e-13);
  }

  double expected(const Case &c, const double ppw)
  {
    const double k = 2. * pi / ppw, w = 2. / dt * std::asin(dt * std::sin(k / 2.));
    Complex      R = 1.;
    for (const double speed : c.speed)
      R *= factor(speed * dt, c.gamma, std::exp(1i * k), std::exp(-1i * w * dt)) /
           factor(speed * dt, c.gamma, std::exp(-1i * k), std::exp(-1i * w * dt));
    return std::abs(R);
  }

  void reflections()
  {
    for (unsigned int order = 1; order <= 3; ++order)
    {
      double worst = 0., largest = 0.;
      for (const double ratio : {.5, .6, .8, 1., 1.25, 1.5, 1.732, 2.})
        for (const double ppw : {10., 20., 40.})
        {
          const Case   c{std::vector<double>(order, ratio)};
          const double R = expected(c, ppw);
          if (R < 1e-3)
            continue;
          worst = std::max(worst, std::abs(reflected(c, ppw) / R - 1.));
          largest = std::max(largest, R);
        }
      below("order " + std::to_string(order) + ", c_a/c 0.5..2, 10..40 ppw: |R| / formula - 1", worst, .02);
    }
    const Case two_speeds{{1., 1.732}}, spring{{1., 1.}, .02};
    below("speeds c and 1.732 c, 20 ppw: |R| / formula - 1",
          reflected(two_speeds, 20.) / expected(two_speeds, 20.) - 1., .02);
    below("order 2, gamma = 0.02: |R| / formula - 1", reflected(spring, 20.) / expected(spring, 20.) - 1.,
          .02);
    const double at_10 = reflected({{1., 1.}}, 10.), at_20 = reflected({{1., 1.}}, 20.);
    below("order 2, c_a = c, 20 ppw: |R|", at_20, 1e-4);
    above("  composed: |R|(10 ppw) / |R|(20 ppw)", at_10 / at_20, 12.);
    const double direct_10 = reflected({{1., 1.}, 0., Rule::direct}, 10.),
                 direct_20 = reflected({{1., 1.}, 0., Rule::direct}, 20.);
    below("  direct interpolation is of first order: the same ratio", direct_10 / direct_20, 2.2);
    above("  and its |R|(20 ppw)", direct_20, 3e-2);
  }

  void refuses()
  {
    BoundaryLine line;
    line.c_p = 1.8;
    line.c_s = 1.;
    line.distance = 10.;
    line.nodes = {0, 1, 2, 3, 4};
    line.position = uniform(5);
    RockModel model;
    model.lines = {line};
    const auto message = [&](const double step, const std::string &name) -> std::string
    {
      try
      {
        make_boundary(name)->attach(model, {}, step);
      }
      catch (const InputError &error)
      {
        return error.what();
      }
      return "";
    };
    const auto check = [](const std::string &what, const bool good) { Columns::report(what, 0., "-", good); };
    check("S = 1 is allowed", message(1. / 1.8, "mtf2").empty());
    check("S > 1 is refused", message(.6, "mtf2").find("(ratio 1.08)") != std::string::npos);
    check("a line too short is refused", message(.1, "mtf3").find("requires 7 nodes") != std::string::npos);
    check("an unknown name is refused, and the known ones are listed",
          message(.1, "mtf7").find("mtf7") != std::string::npos &&
              message(.1, "mtf7").find(boundary_names(", ")) != std::string::npos);
  }
} // namespace

int main()
{
  return Columns::run_all({weights, reflections, refuses});
}
