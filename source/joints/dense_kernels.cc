// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/simd.h>
#include <voussoir/joints/dense_kernels.h>

#include <algorithm>
#include <cstring>

#ifdef __clang__ // vectorises at -O2
#define VOUSSOIR_OPTIMIZE
#else
#define VOUSSOIR_OPTIMIZE __attribute__((optimize("O3")))
#endif
#define VOUSSOIR_CLONES VOUSSOIR_OPTIMIZE __attribute__((target_clones("avx512f", "fma", "avx", "default")))
#define VOUSSOIR_WIDE VOUSSOIR_OPTIMIZE __attribute__((target("avx512f")))
#define VOUSSOIR_OTHERS VOUSSOIR_OPTIMIZE __attribute__((target_clones("fma", "avx", "default")))

namespace Voussoir
{
  namespace
  {
    /** Computes the products of four columns with x. Loads the columns @p next into the cache. */
    VOUSSOIR_CLONES void dot_four(const float *const *column, const float *const *next, const float *x,
                                  const std::size_t n, float *__restrict products)
    {
      constexpr std::size_t line = 16; // values
      float                 sums[4][line] = {};
      std::size_t           i = 0;
      for (; i + line <= n; i += line)
        for (std::size_t k = 0; k < 4; ++k)
        {
          prefetch(next[k] + i, 0);
          for (std::size_t j = 0; j < line; ++j)
            sums[k][j] += column[k][i + j] * x[i + j];
        }
      for (std::size_t k = 0; k < 4; ++k)
      {
        products[k] = 0.f;
        for (std::size_t j = 0; j < line; ++j)
          products[k] += sums[k][j];
        for (std::size_t j = i; j < n; ++j)
          products[k] += column[k][j] * x[j];
      }
    }

    /** Adds three columns. Loads the next three columns into the cache. */
    VOUSSOIR_CLONES void add_three(const float *a, const std::size_t n, const float *x, float *__restrict y)
    {
      constexpr std::size_t line = 16; // values
      const float          *b = a + n, *c = b + n;
      std::size_t           i = 0;
      for (; i + line <= n; i += line)
      {
        for (std::size_t k = 0; k < 3; ++k)
          prefetch(c + i, (k + 1) * n * sizeof(float));
        for (std::size_t j = i; j < i + line; ++j)
          y[j] += x[0] * a[j] + x[1] * b[j] + x[2] * c[j];
      }
      for (; i < n; ++i)
        y[i] += x[0] * a[i] + x[1] * b[i] + x[2] * c[i];
    }

    // A pack has the width of a register; GCC stores wider packs in memory. Sums have as many partial sums
    // as lanes.
    typedef double Wide __attribute__((vector_size(64)));
    typedef double Pack __attribute__((vector_size(32)));
    typedef float  FloatPack __attribute__((vector_size(16)));
    typedef float  WideFloats __attribute__((vector_size(64)));
    typedef float  Floats __attribute__((vector_size(32)));
    const bool     is_wide = __builtin_cpu_supports("avx512f");

    // By reference, because passing vectors by value depends on the processor.
    template <class P, class Number> VOUSSOIR_INLINE void load(const Number *x, P &pack)
    {
      std::memcpy(&pack, x, sizeof(P));
    }

    template <class P> VOUSSOIR_INLINE auto sum(const P &x)
    {
      auto all = x[0];
      for (std::size_t i = 1; i < sizeof(P) / sizeof(x[0]); ++i)
        all += x[i];
      return all;
    }

    /** Computes y += A x and z += A^T v for four columns of A with a distance of @p leading values. */
    template <class P, class Number>
    VOUSSOIR_INLINE void four_columns(const Number *A, const std::size_t leading, const std::size_t m,
                                      const Number *x, Number *y, const Number *v, Number *z)
    {
      constexpr std::size_t lanes = sizeof(P) / sizeof(Number);
      const Number         *column[4] = {A, A + leading, A + 2 * leading, A + 3 * leading};
      const Number          factor[4] = {x[0], x[1], x[2], x[3]};
      P                     sums[4] = {};
      std::size_t           i = 0;
      for (; i + lanes <= m; i += lanes)
      {
        P v_i, y_i, a;
        load(v + i, v_i);
        load(y + i, y_i);
        for (unsigned int c = 0; c < 4; ++c)
        {
          prefetch(column[c] + i, 4 * leading * sizeof(Number)); // the columns of the next call
          load(column[c] + i, a);
          y_i += factor[c] * a;
          sums[c] += a * v_i;
        }
        std::memcpy(y + i, &y_i, sizeof(P));
      }
      for (; i < m; ++i)
        for (unsigned int c = 0; c < 4; ++c)
        {
          y[i] += factor[c] * column[c][i];
          sums[c][0] += column[c][i] * v[i];
        }
      for (unsigned int c = 0; c < 4; ++c)
        z[c] += sum(sums[c]);
    }

    template <class Number>
    VOUSSOIR_INLINE void one_column(const Number *a, const std::size_t m, const Number x, Number *y,
                                    const Number *v, Number &z)
    {
      Number product = 0;
      for (std::size_t i = 0; i < m; ++i)
      {
        y[i] += x * a[i];
        product += a[i] * v[i];
      }
      z += product;
    }

    template <class P>
    VOUSSOIR_INLINE void both(const double *A, const std::size_t m, const std::size_t n, const double *x,
                              double *y, const double *v, double *z)
    {
      std::size_t c = 0;
      for (; c + 4 <= n; c += 4)
        four_columns<P>(A + c * m, m, m, x + c, y, v, z + c);
      for (; c < n; ++c)
        one_column(A + c * m, m, x[c], y, v, z[c]);
    }

    template <class P, class Number>
    VOUSSOIR_INLINE void symmetric(const Number *A, const std::size_t leading, const std::size_t n,
                                   const Number *x, Number *y)
    {
      for (std::size_t c = 0; c < n; c += 4)
      {
        const std::size_t end = std::min(c + 4, n);
        for (std::size_t j = c; j < end; ++j) // diagonal block
        {
          y[j] += A[j * leading + j] * x[j];
          one_column(A + j * leading + j + 1, end - j - 1, x[j], y + j + 1, x + j + 1, y[j]);
        }
        if (end < n)
          four_columns<P>(A + c * leading + end, leading, n - end, x + c, y + end, x + end, y + c);
      }
    }

    VOUSSOIR_WIDE void both_wide(const double *A, const std::size_t m, const std::size_t n, const double *x,
                                 double *y, const double *v, double *z)
    {
      both<Wide>(A, m, n, x, y, v, z);
    }
    VOUSSOIR_OTHERS void both_others(const double *A, const std::size_t m, const std::size_t n,
                                     const double *x, double *y, const double *v, double *z)
    {
      both<Pack>(A, m, n, x, y, v, z);
    }

    VOUSSOIR_WIDE void symmetric_wide(const double *A, const std::size_t n, const double *x, double *y)
    {
      symmetric<Wide>(A, n, n, x, y);
    }
    VOUSSOIR_WIDE void symmetric_wide_floats(const float *A, const std::size_t leading, const std::size_t n,
                                             const float *x, float *y)
    {
      symmetric<WideFloats>(A, leading, n, x, y);
    }
    VOUSSOIR_OTHERS void symmetric_others(const double *A, const std::size_t n, const double *x, double *y)
    {
      symmetric<Pack>(A, n, n, x, y);
    }
    VOUSSOIR_OTHERS void symmetric_floats(const float *A, const std::size_t leading, const std::size_t n,
                                          const float *x, float *y)
    {
      symmetric<Floats>(A, leading, n, x, y);
    }

    VOUSSOIR_CLONES double product(const float *x, const float *y, const std::size_t n)
    {
      constexpr std::size_t width = 4;
      Pack                  sums[4] = {};
      std::size_t           i = 0;
      for (; i + 4 * width <= n; i += 4 * width)
        for (unsigned int k = 0; k < 4; ++k)
        {
          FloatPack a, b;
          load(x + i + k * width, a);
          load(y + i + k * width, b);
          sums[k] += __builtin_convertvector(a, Pack) * __builtin_convertvector(b, Pack);
        }
      double rest = 0.;
      for (; i < n; ++i)
        rest += double(x[i]) * y[i];
      return sum((sums[0] + sums[1]) + (sums[2] + sums[3])) + rest;
    }

    VOUSSOIR_CLONES void add_scaled(const float factor, const float *x, const std::size_t n,
                                    float *__restrict y)
    {
      for (std::size_t i = 0; i < n; ++i)
        y[i] += factor * x[i];
    }
  } // namespace

  void add_three_columns(const float *A, const std::size_t n, const float *x, float *y)
  {
    add_three(A, n, x, y);
  }

  void add_both(const double *A, const std::size_t m, const std::size_t n, const double *x, double *y,
                const double *v, double *z)
  {
    (is_wide ? both_wide : both_others)(A, m, n, x, y, v, z);
  }

  void add_symmetric(const double *A, const std::size_t n, const double *x, double *y)
  {
    (is_wide ? symmetric_wide : symmetric_others)(A, n, x, y);
  }

  void add_symmetric(const float *A, const std::size_t leading, const std::size_t n, const float *x, float *y)
  {
    (is_wide ? symmetric_wide_floats : symmetric_floats)(A, leading, n, x, y);
  }

  double dot(const float *x, const float *y, const std::size_t n)
  {
    return product(x, y, n);
  }

  void add(const float factor, const float *x, const std::size_t n, float *y)
  {
    add_scaled(factor, x, n, y);
  }

  void take_products(const float *A, const std::size_t leading, const std::size_t n,
                     const std::vector<unsigned int> &columns, const float *x, float *y)
  {
    const std::size_t size = columns.size();
    const auto column = [&](const std::size_t k) { return A + columns[std::min(k, size - 1)] * leading; };
    for (std::size_t k = 0; k < size; k += 4)
    {
      const float *present[4], *next[4];
      float        products[4];
      for (std::size_t j = 0; j < 4; ++j)
      {
        present[j] = column(k + j);
        next[j] = column(k + j + 4);
      }
      dot_four(present, next, x, n, products);
      for (std::size_t j = 0; j < 4 && k + j < size; ++j)
        y[columns[k + j]] = products[j];
    }
  }
} // namespace Voussoir
