// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_dense_kernels_h
#define voussoir_dense_kernels_h

#include <cstddef>
#include <vector>

namespace Voussoir
{
  // Products with dense blocks of joints. Variants for AVX-512, AVX and plain x86-64 are compiled; the
  // program selects one at run time.

  /** Returns the leading dimension for @p n numbers of single precision: a multiple of the SIMD width. */
  constexpr std::size_t padded(const std::size_t n)
  {
    return (n + 15) / 16 * 16;
  }

  /** Sets y[k] to the product of column k of A with @p x, for the @p columns k; other values of y are unchanged. Columns
   * have @p n values and a distance of @p leading values. */
  void take_products(const float *A, std::size_t leading, std::size_t n,
                     const std::vector<unsigned int> &columns, const float *x, float *y);

  /** Adds x[0] A_0 + x[1] A_1 + x[2] A_2 to @p y, for the first three columns of A with @p n values each. */
  void add_three_columns(const float *A, std::size_t n, const float *x, float *y);

  /** Computes y += A x and z += A^T v in one pass over A, which has @p m rows and @p n columns, by column.
   * The vectors must not overlap. */
  void add_both(const double *A, std::size_t m, std::size_t n, const double *x, double *y, const double *v,
                double *z);

  /** Computes y += A x for a symmetric A with @p n rows. Only the lower triangle is read. */
  void add_symmetric(const double *A, std::size_t n, const double *x, double *y);
  /** The same in single precision, for columns with a distance of @p leading values. */
  void add_symmetric(const float *A, std::size_t leading, std::size_t n, const float *x, float *y);

  /** Returns the scalar product of two vectors in single precision, added up in double precision. */
  double dot(const float *x, const float *y, std::size_t n);

  /** Computes y += factor x. */
  void add(float factor, const float *x, std::size_t n, float *y);
} // namespace Voussoir

#endif
