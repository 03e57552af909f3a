// SPDX-License-Identifier: GPL-3.0-or-later
// Vectors of `lanes` floats. for_lanes.h includes this file in several namespaces.

using Vector = float __attribute__((vector_size(4 * lanes), may_alias));
using Mask = int __attribute__((vector_size(4 * lanes)));

VOUSSOIR_INLINE Vector larger(const Vector a, const Vector b)
{
  return a > b ? a : b;
}

VOUSSOIR_INLINE Vector smaller(const Vector a, const Vector b)
{
  return a < b ? a : b;
}

VOUSSOIR_INLINE bool any(const Mask mask)
{
  int sum = 0;
  for (int lane = 0; lane < lanes; ++lane)
    sum |= mask[lane];
  return sum != 0;
}
