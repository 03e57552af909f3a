// SPDX-License-Identifier: GPL-3.0-or-later
// Includes the kernel VOUSSOIR_KERNEL in the namespaces Lanes16, Lanes8 and Lanes4, each compiled for a set of
// instructions with vectors of lane_vectors.h. Without AVX all have four lanes. The including source selects one by
// for_lanes(), includes base/simd.h and, for VOUSSOIR_SQUARE_ROOT, immintrin.h.

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"
#pragma GCC            push_options
#pragma GCC            target("avx512f,avx512dq,avx512vl,avx512bw,avx2,fma")
namespace Lanes16
{
  constexpr int lanes = 16;
#define VOUSSOIR_SQUARE_ROOT(a) (Vector) _mm512_maskz_sqrt_ps(0xffff, (__m512)a)
#include <voussoir/base/lane_vectors.h>
#include VOUSSOIR_KERNEL
#undef VOUSSOIR_SQUARE_ROOT
} // namespace Lanes16
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("avx2,fma")
namespace Lanes8
{
  constexpr int lanes = 8;
#define VOUSSOIR_SQUARE_ROOT(a) (Vector) _mm256_sqrt_ps((__m256)a)
#include <voussoir/base/lane_vectors.h>
#include VOUSSOIR_KERNEL
#undef VOUSSOIR_SQUARE_ROOT
} // namespace Lanes8
#pragma GCC            pop_options
#pragma GCC diagnostic pop
#define VOUSSOIR_FOR_LANES(function) for_lanes(Lanes16::function, Lanes8::function, Lanes4::function)
#else
#define VOUSSOIR_FOR_LANES(function) Lanes4::function
#endif
namespace Lanes4
{
  constexpr int lanes = 4;
#define VOUSSOIR_SQUARE_ROOT(a) (Vector{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])})
#include <voussoir/base/lane_vectors.h>
#include VOUSSOIR_KERNEL
#undef VOUSSOIR_SQUARE_ROOT
} // namespace Lanes4
