// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/joints/dense_kernels.h>

#define VOUSSOIR_CLONES __attribute__((target_clones("avx512f", "fma", "avx", "default"), optimize("O3")))

namespace Voussoir
{
  namespace
  {
    VOUSSOIR_CLONES void add_four(const float *a, const float *b, const float *c, const float *d,
                                  const float *x, const std::size_t n, float *__restrict y)
    {
      for (std::size_t i = 0; i < n; ++i)
        y[i] += x[0] * a[i] + x[1] * b[i] + x[2] * c[i] + x[3] * d[i];
    }

    VOUSSOIR_CLONES void add_three(const float *a, const float *b, const float *c, const float *x,
                                   const std::size_t n, float *__restrict y)
    {
      for (std::size_t i = 0; i < n; ++i)
        y[i] += x[0] * a[i] + x[1] * b[i] + x[2] * c[i];
    }
  } // namespace

  void add_three_columns(const float *A, const std::size_t n, const float *x, float *y)
  {
    add_three(A, A + n, A + 2 * n, x, n, y);
  }

  void add_columns(const float *A, const std::size_t leading, const std::size_t n,
                   const std::vector<unsigned int> &columns, const float *x, float *y)
  {
    const std::size_t size = columns.size();
    for (std::size_t k = 0; k < size; k += 4)
    {
      const float *column[4];
      float        factor[4];
      for (std::size_t j = 0; j < 4; ++j)
      {
        const unsigned int c = columns[k + j < size ? k + j : k];
        column[j] = A + c * leading;
        factor[j] = k + j < size ? x[c] : 0.f;
      }
      add_four(column[0], column[1], column[2], column[3], factor, n, y);
    }
  }
} // namespace Voussoir
