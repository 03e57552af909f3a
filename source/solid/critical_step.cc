// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/tridiagonal.h>
#include <voussoir/solid/critical_step.h>

#include <cmath>

namespace Voussoir
{
  /** Lanczos' method for D K D with D = M^(-1/2). The estimate of the square is a lower bound, so the residual is added
   * (Zhou and Li 2011, Linear Algebra Appl. 435, 480-493). The iteration ends with a residual of 1e-5 of the square. */
  double largest_frequency(const std::function<void(const double *x, double *y)> &multiply,
                           const std::vector<double>                             &mass)
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
    return std::sqrt(found + residual);
  }
} // namespace Voussoir
