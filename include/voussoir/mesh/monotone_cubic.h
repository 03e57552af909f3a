// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_monotone_cubic_h
#define voussoir_monotone_cubic_h

#include <vector>

namespace Voussoir
{
  /** Monotone cubic interpolation (Fritsch and Carlson, SIAM J. Numer. Anal. 17, 1980), with the slopes of Fritsch and
   * Butland (SIAM J. Sci. Stat. Comput. 5, 1984): no new extremes between the points. Boost's pchip requires four
   * points. */
  class MonotoneCubic
  {
  public:
    /** Interpolates values @p y at increasing positions @p x, at least two. */
    MonotoneCubic(std::vector<double> x, std::vector<double> y);

    /** Returns the value. Outside of the points, the cubic polynomial at the end continues. */
    double operator()(double position) const;

  private:
    std::vector<double> x, y, tangent;
  };
} // namespace Voussoir

#endif
