// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_simd_h
#define voussoir_simd_h

#include <cstddef>
#include <cstdint>
#ifdef __x86_64__
#include <immintrin.h>
#endif

// Helpers of kernels with the vector types of GCC and clang. Only sources with kernels include this file.

#define VOUSSOIR_INLINE inline __attribute__((always_inline))
#define VOUSSOIR_AVX2 __attribute__((target("avx2,fma")))

/** AVX without fused operations: the results do not depend on the processor. */
#if defined(__x86_64__) && defined(__GNUC__)
#define VOUSSOIR_WITH_AVX __attribute__((target_clones("avx", "default")))
#else
#define VOUSSOIR_WITH_AVX
#endif

/** Lanes of the vectors a and b, which have integers or floating-point numbers, by constant indices. */
#ifdef __clang__
#define VOUSSOIR_SHUFFLE(a, b, ...) __builtin_shufflevector(a, b, __VA_ARGS__)
#else
#define VOUSSOIR_SHUFFLE(a, b, ...) __builtin_shuffle(a, b, decltype((a) < (b)){__VA_ARGS__})
#endif

namespace Voussoir
{
  /** Returns whether the processor supports functions with VOUSSOIR_AVX2. */
  inline bool has_avx2()
  {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  }

  /** Loads the @p n_bytes bytes that begin @p distance bytes after @p p into the second-level cache. They need not
   * belong to an object. Kernels whose data do not fit into the cache load the later data ahead of their use: the
   * hardware follows one sequence of addresses, but not the step to the next block or column. */
  VOUSSOIR_INLINE void prefetch(const void *p, const std::ptrdiff_t distance, const std::size_t n_bytes = 64)
  {
    const std::uintptr_t begin = reinterpret_cast<std::uintptr_t>(p) + distance;
    for (std::size_t line = 0; line < n_bytes; line += 64)
      __builtin_prefetch(reinterpret_cast<const void *>(begin + line), 0, 2);
  }
} // namespace Voussoir

#endif
