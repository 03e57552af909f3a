// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_parallel_h
#define voussoir_parallel_h

#include <algorithm>
#include <cstddef>
#include <exception>

namespace Voussoir
{
  /** action(i) for i = 0 .. n - 1 by all threads, in any order, one at a time each. An exception must not
   * leave a region of OpenMP, which would end the process: the first one is thrown again when all threads are
   * done. For work that is worth a thread's while (a body, a joint, a column), not for loops over nodes. */
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

  /** The same for small work (a pair of nodes), in chunks. */
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
} // namespace Voussoir

#endif
