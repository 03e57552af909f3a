// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_parallel_h
#define voussoir_parallel_h

#include <algorithm>
#include <cstddef>
#include <exception>
#include <vector>

namespace Voussoir
{
  /** Calls @p action(i) for i = 0 ... n - 1 with all threads, in any order; each thread takes one i at a
   * time. An exception must not leave an OpenMP region, since that would end the process. The first exception
   * is therefore thrown again after all calls. Meant for large tasks (a body, a joint, a column), not for
   * loops over nodes. */
  template <class Action> void for_each_parallel(const int n, const Action &action)
  {
    std::exception_ptr failure;
#pragma omp parallel for schedule(dynamic) if (n > 1)
    for (int i = 0; i < n; ++i)
      try
      {
        action(i);
      }
      catch (...)
      {
#pragma omp critical
        if (!failure)
          failure = std::current_exception();
      }
    if (failure)
      std::rethrow_exception(failure);
  }

  /** Calls @p action(i) for i = 0 ... n - 1 with all threads, in chunks of 128. Meant for small tasks (a
   * pair of nodes). */
  template <class Action> void for_each_in_chunks(const std::size_t n, const Action &action)
  {
    constexpr std::size_t chunk = 128;
    for_each_parallel((n + chunk - 1) / chunk,
                      [&](const std::size_t c)
                      {
                        for (std::size_t i = c * chunk; i < std::min(n, (c + 1) * chunk); ++i)
                          action(i);
                      });
  }

  /** Returns the sum of @p action(first, last) over ranges of 512 of 0 ... n - 1. The ranges are added in sequence,
   * so the result is the same for any number of threads. Exceptions of @p action end the process. Sums: std::array of
   * double. */
  template <class Sums, class Action> Sums sum_of_ranges(const std::size_t n, const Action &action)
  {
    constexpr std::size_t range = 512;
    std::vector<Sums>     parts((n + range - 1) / range);
    const int             n_parts = parts.size();
#pragma omp parallel for schedule(static) if (n_parts > 1)
    for (int p = 0; p < n_parts; ++p)
      parts[p] = action(p * range, std::min(n, (p + 1) * range));
    Sums sum{};
    for (const Sums &part : parts)
      for (std::size_t k = 0; k < sum.size(); ++k)
        sum[k] += part[k];
    return sum;
  }
} // namespace Voussoir

#endif
