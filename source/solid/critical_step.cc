// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/tridiagonal.h>
#include <voussoir/solid/critical_step.h>

#include <cmath>

namespace Voussoir
{
  namespace
  {
    /** Returns the node that moves most in a mode near the highest one, by the power method. @p scale: D, @p square: of
     * the frequency. */
    unsigned int moving_most(const std::function<void(const double *x, double *y)> &multiply,
                             const std::vector<double> &scale, const double square)
    {
      constexpr unsigned int powers = 100;
      std::vector<double>    mode(scale.size()), x(scale.size()), y(scale.size());
      for (std::size_t i = 0; i < mode.size(); ++i)
        mode[i] = 1. + .5 * std::sin(12.9898 * i);
      for (unsigned int k = 0; k < powers; ++k)
      {
        for (std::size_t i = 0; i < mode.size(); ++i)
          x[i] = scale[i] * mode[i] / square;
        multiply(x.data(), y.data());
        for (std::size_t i = 0; i < mode.size(); ++i)
          mode[i] = scale[i] * y[i];
      }
      std::size_t most = 0;
      for (std::size_t i = 0; i < mode.size(); ++i)
        if (std::abs(scale[i] * mode[i]) > std::abs(scale[most] * mode[most]))
          most = i;
      return most / 3;
    }
  } // namespace

  /** Lanczos' method for D K D with D = M^(-1/2). The estimate of the square is a lower bound, so the residual is added
   * (Zhou and Li 2011, Linear Algebra Appl. 435, 480-493). The iteration ends with a residual of 1e-5 of the square. */
  double largest_frequency(const std::function<void(const double *x, double *y)> &multiply,
                           const std::vector<double> &mass, unsigned int *const node)
  {
    constexpr unsigned int most = 1000, interval = 10;
    constexpr double       enough = 1e-5;
    const int              n = 3 * static_cast<int>(mass.size());
    std::vector<double>    scale(n), v(n), x(n), next(n), before(n, 0.);
    double                 size = 0., found = 0., residual = 0.;
    for (int i = 0; i < n; ++i)
    {
      scale[i] = mass[i / 3] > 0. ? 1. / std::sqrt(mass[i / 3]) : 0.;
      v[i] = 1. + .5 * std::sin(12.9898 * i); // smooth and rough parts
      size += v[i] * v[i];
    }
    for (double &value : v)
      value /= std::sqrt(size);
    Tridiagonal T;
    for (unsigned int iteration = 1; iteration <= most; ++iteration)
    {
      for (int i = 0; i < n; ++i)
        x[i] = scale[i] * v[i];
      multiply(x.data(), next.data());
      double product = 0., square = 0.;
      for (int i = 0; i < n; ++i)
      {
        next[i] *= scale[i];
        product += v[i] * next[i];
      }
      const double off_diagonal = T.off_diagonal.empty() ? 0. : T.off_diagonal.back();
      for (int i = 0; i < n; ++i)
      {
        next[i] -= product * v[i] + off_diagonal * before[i];
        square += next[i] * next[i];
      }
      T.diagonal.push_back(product);
      T.off_diagonal.push_back(std::sqrt(square));
      const bool is_last = !(square > 1e-20 * product * product) || iteration == most;
      if (iteration % interval == 0 || is_last)
      {
        found = T.largest_eigenvalue();
        residual = T.residual(found);
        if (is_last || !(residual > enough * found))
          break;
      }
      before.swap(v);
      for (int i = 0; i < n; ++i)
        v[i] = next[i] / T.off_diagonal.back();
    }
    if (node != nullptr)
      *node = moving_most(multiply, scale, found);
    return std::sqrt(found + residual);
  }
} // namespace Voussoir
