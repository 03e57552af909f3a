// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/mesh/arch_shape.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  double ArchShape::slope(const Bank bank, const double u) const
  {
    // Three points determine a parabola. At the crown and at the abutment they lie on one side.
    const double last = end(bank, top()), h = 1e-4 * last, middle = std::clamp(u, h, last - h);
    const auto   a = point(bank, middle - h, top(), 0), b = point(bank, middle, top(), 0),
               c = point(bank, middle + h, top(), 0);
    const auto derivative = [&](const unsigned int d)
    { return c[d] - a[d] + 2 * (u - middle) / h * (a[d] - 2 * b[d] + c[d]); };
    return derivative(0) / derivative(1);
  }

  double ArchShape::crest_length(const Bank bank, const double u) const
  {
    // Chords of 32 and of 16 parts, and Richardson's extrapolation.
    constexpr unsigned int                   n = 32;
    std::array<std::array<double, 3>, n + 1> points;
    for (unsigned int i = 0; i <= n; ++i)
      points[i] = point(bank, u * i / n, top(), 0);
    const auto chords = [&](const unsigned int step)
    {
      double length = 0;
      for (unsigned int i = step; i <= n; i += step)
        length += std::hypot(points[i][0] - points[i - step][0], points[i][1] - points[i - step][1]);
      return length;
    };
    return (4 * chords(1) - chords(2)) / 3;
  }
} // namespace Voussoir
