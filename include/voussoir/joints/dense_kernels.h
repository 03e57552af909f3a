// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_dense_kernels_h
#define voussoir_dense_kernels_h

#include <cstddef>
#include <vector>

namespace Voussoir
{
  // Products with dense blocks of joints, compiled for AVX-512, AVX and plain x86-64 and chosen at run time.

  /** @p n numbers of single precision in whole SIMD registers: a leading dimension. */
  constexpr std::size_t padded(const std::size_t n)
  {
    return (n + 15) / 16 * 16;
  }

  /** y += sum of x[k] A_k over the @p columns k of A, by column, of @p n entries @p leading apart; @p y: n
   * entries. */
  void add_columns(const float *A, std::size_t leading, std::size_t n,
                   const std::vector<unsigned int> &columns, const float *x, float *y);

  /** y += x[0] A_0 + x[1] A_1 + x[2] A_2 for the first three columns of A, @p n entries each. */
  void add_three_columns(const float *A, std::size_t n, const float *x, float *y);

  /** y += A x and z += A^T v in one pass over A, @p m x @p n by column. No two of the vectors may overlap. */
  void add_both(const double *A, std::size_t m, std::size_t n, const double *x, double *y, const double *v,
                double *z);

  /** y += A x for a symmetric A of @p n rows, of which the lower triangle is read. */
  void add_symmetric(const double *A, std::size_t n, const double *x, double *y);

  /** Product of two vectors of single precision, added up in double precision. */
  double dot(const float *x, const float *y, std::size_t n);

  /** y += factor x. */
  void add(float factor, const float *x, std::size_t n, float *y);
} // namespace Voussoir

#endif
