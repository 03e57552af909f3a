// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/excess.h>

#include <cmath>

namespace Voussoir
{
  std::size_t count_excess(const double *x, const std::size_t n, const double bound)
  {
    long count = 0;
#pragma omp parallel for simd schedule(static) reduction(+ : count) if (n > 10000)
    for (std::size_t i = 0; i < n; ++i)
      count += !(std::abs(x[i]) <= bound); // also counts values that are not numbers
    return count;
  }

  std::size_t find_excess(const Unknowns &x, const double bound)
  {
    if (count_excess(x.data(), x.size(), bound) == 0)
      return x.size();
    std::size_t largest = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (!std::isfinite(x[i]))
        return i;
      else if (std::abs(x[i]) > std::abs(x[largest]))
        largest = i;
    return largest;
  }
} // namespace Voussoir
