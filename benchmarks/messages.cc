// SPDX-License-Identifier: GPL-3.0-or-later
// What the messages of a run with several ranks cost: mpirun -np 2 build/benchmarks/benchmark_messages
// Prints for doc/performance.md the wall time of a gathering, of a decision by all, and of a swap of two
// neighbours [us].

#include <voussoir/base/log.h>
#include <voussoir/base/ranks.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

using namespace Voussoir;

namespace
{
  template <class Action> double microseconds(const Action &action)
  {
    std::vector<double> times;
    for (unsigned int k = 0; k < 41; ++k)
    {
      constexpr unsigned int n = 50;
      const Stopwatch        watch;
      for (unsigned int i = 0; i < n; ++i)
        action();
      times.push_back(1e6 * watch.seconds() / n);
    }
    std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
    return times[times.size() / 2];
  }
} // namespace

int main()
{
  const char *size = std::getenv("OMPI_COMM_WORLD_SIZE");
  Ranks::start(size == nullptr ? 1 : std::atoi(size));
  if (Ranks::size() == 1)
  {
    std::fprintf(stderr, "Start it by mpirun, on two ranks or more.\n");
    return 2;
  }
  std::printf("decision by all %.1f us\n| doubles | gathering [us] | swap [us] |\n|---|---|---|\n",
              microseconds([] { Ranks::any(0); }));
  for (const std::size_t n : {1u, 1000u, 10000u, 100000u, 1000000u})
  {
    std::vector<double>      data(n), in(n);
    std::vector<std::size_t> begin;
    for (unsigned int r = 0; r <= Ranks::size(); ++r)
      begin.push_back(n * r / Ranks::size());
    const double gathering = microseconds([&] { Ranks::gather(data.data(), begin); });
    const double swap = microseconds(
        [&]
        {
          if (Ranks::rank() < 2)
            Ranks::exchange({{1 - Ranks::rank(), data.data(), n, in.data(), n}});
        });
    std::printf("| %zu | %.1f | %.1f |\n", n, gathering, swap);
  }
  return Ranks::finish(0, "");
}
