// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/solid/packed_stiffness.h>

#include <algorithm>

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#define VOUSSOIR_WIDE_VECTORS
#endif

namespace Voussoir
{
  namespace
  {
    /** Rows from first to last, without the last one, of y = K x. */
    struct RowProduct
    {
      const std::size_t  *start;
      const unsigned int *column;
      const double       *value;
      const double       *x;
      double             *y;
      int                 first, last;
    };

    void multiply_rows(const RowProduct &rows)
    {
      for (int row = rows.first; row < rows.last; ++row)
        for (unsigned int c = 0; c < 3; ++c)
        {
          double sum = 0.;
          for (std::size_t k = rows.start[row]; k < rows.start[row + 1]; ++k)
            for (unsigned int d = 0; d < 3; ++d)
              sum += rows.value[9 * k + 3 * d + c] * rows.x[3 * std::size_t(rows.column[k]) + d];
          rows.y[3 * row + c] = sum;
        }
    }

#ifdef VOUSSOIR_WIDE_VECTORS
    /** The fourth value of a vector is unused: it belongs to the next column. */
    __attribute__((target("avx2,fma"))) void multiply_rows_avx2(const RowProduct &rows)
    {
      for (int row = rows.first; row < rows.last; ++row)
      {
        __m256d sums[3] = {_mm256_setzero_pd(), _mm256_setzero_pd(), _mm256_setzero_pd()};
        for (std::size_t k = rows.start[row]; k < rows.start[row + 1]; ++k)
        {
          const double *v = rows.value + 9 * k;
          const double *x = rows.x + 3 * std::size_t(rows.column[k]);
          sums[0] = _mm256_fmadd_pd(_mm256_loadu_pd(v), _mm256_broadcast_sd(x), sums[0]);
          sums[1] = _mm256_fmadd_pd(_mm256_loadu_pd(v + 3), _mm256_broadcast_sd(x + 1), sums[1]);
          sums[2] = _mm256_fmadd_pd(_mm256_loadu_pd(v + 6), _mm256_broadcast_sd(x + 2), sums[2]);
        }
        double sum[4];
        _mm256_storeu_pd(sum, _mm256_add_pd(_mm256_add_pd(sums[0], sums[1]), sums[2]));
        for (unsigned int c = 0; c < 3; ++c)
          rows.y[3 * row + c] = sum[c];
      }
    }
#endif

    bool has_wide_vectors()
    {
#ifdef VOUSSOIR_WIDE_VECTORS
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
      return false;
#endif
    }
  } // namespace

  PackedStiffness::PackedStiffness(const Structure &structure) : start(1, 0)
  {
    for (const Body &body : structure.bodies)
      for (unsigned int row = 0; row < body.n_nodes(); ++row)
      {
        for (std::size_t k = body.stiffness.start[row]; k < body.stiffness.start[row + 1]; ++k)
        {
          column.push_back(body.first_node + body.stiffness.column[k]);
          for (unsigned int c = 0; c < 9; ++c)
            value.push_back(body.stiffness.value[k][3 * (c % 3) + c / 3]);
        }
        start.push_back(column.size());
      }
    value.insert(value.end(), 3, 0.);
  }

  void PackedStiffness::multiply(const Unknowns &u, Unknowns &y) const
  {
    constexpr int per_chunk = 64;
    const int     n = static_cast<int>(start.size()) - 1;
    const bool    is_wide = has_wide_vectors();
    y.resize(u.size());
#pragma omp parallel for schedule(static)
    for (int first = 0; first < n; first += per_chunk)
    {
      const RowProduct rows = {start.data(),
                               column.data(),
                               value.data(),
                               u.data(),
                               y.data(),
                               first,
                               std::min(first + per_chunk, n)};
#ifdef VOUSSOIR_WIDE_VECTORS
      if (is_wide)
        multiply_rows_avx2(rows);
      else
#endif
        multiply_rows(rows);
    }
  }
} // namespace Voussoir
