// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/mesh/monotone_cubic.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  MonotoneCubic::MonotoneCubic(std::vector<double> positions, std::vector<double> values)
      : x(std::move(positions)), y(std::move(values)), tangent(x.size(), 0.)
  {
    const std::size_t n = x.size();
    const auto        step = [&](const std::size_t i) { return x[i + 1] - x[i]; };
    const auto        slope = [&](const std::size_t i) { return (y[i + 1] - y[i]) / step(i); };
    for (std::size_t i = 1; i + 1 < n; ++i)
      if (slope(i - 1) * slope(i) > 0)
      {
        const double a = 2 * step(i) + step(i - 1), b = step(i) + 2 * step(i - 1);
        tangent[i] = (a + b) / (a / slope(i - 1) + b / slope(i));
      }
    // The ends: three points, without a change of sign.
    const auto at_end = [&](const std::size_t i, const std::size_t j)
    {
      if (n == 2)
        return slope(0);
      const double t = ((2 * step(i) + step(j)) * slope(i) - step(i) * slope(j)) / (step(i) + step(j));
      return t * slope(i) <= 0 ? 0. : std::copysign(std::min(std::abs(t), 3 * std::abs(slope(i))), slope(i));
    };
    tangent.front() = at_end(0, std::min<std::size_t>(1, n - 2));
    tangent.back() = at_end(n - 2, n < 3 ? 0 : n - 3);
  }

  double MonotoneCubic::operator()(const double position) const
  {
    const auto        next = std::lower_bound(x.begin() + 1, x.end() - 1, position);
    const std::size_t i = next - x.begin() - 1;
    const double      h = x[i + 1] - x[i], t = (position - x[i]) / h, s = 1 - t;
    return y[i] * (1 + 2 * t) * s * s + y[i + 1] * t * t * (3 - 2 * t) +
           h * (tangent[i] * t * s * s - tangent[i + 1] * t * t * s);
  }
} // namespace Voussoir
