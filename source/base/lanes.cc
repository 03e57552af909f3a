// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/lanes.h>
#include <voussoir/base/simd.h>

#include <cstdlib>

namespace Voussoir
{
  unsigned int n_lanes()
  {
    const char        *wanted = std::getenv("VOUSSOIR_LANES");
    const unsigned int most = wanted != nullptr ? std::atoi(wanted) : most_lanes;
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
    if (most >= 16 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"))
      return 16;
    if (most >= 8 && has_avx2())
      return 8;
#endif
    return 4;
  }
} // namespace Voussoir
