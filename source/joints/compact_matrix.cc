// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/simd.h>
#include <voussoir/joints/compact_matrix.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace Voussoir
{
  namespace
  {
    constexpr std::size_t width = 8;            // rows and columns of a block
    constexpr std::size_t size = width * width; // entries of a block
    constexpr std::size_t ahead = 2048;         // distance of the prefetch [bytes]
    constexpr double      most = std::numeric_limits<std::int16_t>::max();
    typedef float         Pack __attribute__((vector_size(4 * width)));
    typedef std::int32_t  Integers __attribute__((vector_size(4 * width)));
    typedef std::int16_t  Shorts __attribute__((vector_size(2 * width)));
    const bool            is_wide = has_avx2();

    template <class Number> constexpr bool has_scale = std::is_integral<Number>::value;

    std::size_t n_blocks(const std::size_t n)
    {
      return (n + width - 1) / width;
    }

    VOUSSOIR_INLINE void load(const float *p, Pack &pack)
    {
      std::memcpy(&pack, p, sizeof(pack));
    }

    VOUSSOIR_INLINE void load(const std::int16_t *p, Pack &pack)
    {
      Shorts entries;
      std::memcpy(&entries, p, sizeof(entries));
      pack = __builtin_convertvector(__builtin_convertvector(entries, Integers), Pack);
    }

    /** Computes y += A x. @p rows, @p columns: numbers of blocks; @p scale: of the blocks, 1 for floats. */
    template <class Number>
    VOUSSOIR_INLINE void add(const Number *A, const float *scale, const std::size_t rows,
                             const std::size_t columns, const float *x, float *y)
    {
      for (std::size_t c = 0; c < columns; ++c, x += width)
        for (std::size_t r = 0; r < rows; ++r, A += size, ++scale)
        {
          prefetch(A, ahead, size * sizeof(Number));
          Pack y_r, even = {}, odd = {}, a;
          std::memcpy(&y_r, y + width * r, sizeof(Pack));
          if constexpr (!has_scale<Number>)
            even = y_r;
          for (std::size_t k = 0; k < width; k += 2)
          {
            load(A + width * k, a);
            even += x[k] * a;
            load(A + width * (k + 1), a);
            odd += x[k + 1] * a;
          }
          odd += even;
          y_r = has_scale<Number> ? y_r + *scale * odd : odd;
          std::memcpy(y + width * r, &y_r, sizeof(Pack));
        }
    }

    /** Computes y += A^T x. */
    template <class Number>
    VOUSSOIR_INLINE void add_transposed(const Number *A, const float *scale, const std::size_t rows,
                                        const std::size_t columns, const float *x, float *y)
    {
      for (std::size_t c = 0; c < columns; ++c, y += width)
      {
        Pack sums[width] = {};
        for (std::size_t r = 0; r < rows; ++r, A += size, ++scale)
        {
          prefetch(A, ahead, size * sizeof(Number));
          Pack x_r, a;
          std::memcpy(&x_r, x + width * r, sizeof(Pack));
          x_r *= *scale;
          for (std::size_t k = 0; k < width; ++k)
          {
            load(A + width * k, a);
            sums[k] += x_r * a;
          }
        }
        for (std::size_t k = 0; k < width; ++k)
          y[k] += ((sums[k][0] + sums[k][1]) + (sums[k][2] + sums[k][3])) +
                  ((sums[k][4] + sums[k][5]) + (sums[k][6] + sums[k][7]));
      }
    }

    template <class Number>
    VOUSSOIR_INLINE void multiply(const bool transposed, const Number *A, const float *scale,
                                  const std::size_t rows, const std::size_t columns, const float *x, float *y)
    {
      transposed ? add_transposed(A, scale, rows, columns, x, y) : add(A, scale, rows, columns, x, y);
    }

    VOUSSOIR_AVX2 void wide(const bool transposed, const std::int16_t *A, const float *scale,
                            const std::size_t rows, const std::size_t columns, const float *x, float *y)
    {
      multiply(transposed, A, scale, rows, columns, x, y);
    }

    VOUSSOIR_AVX2 void wide(const bool transposed, const float *A, const float *scale, const std::size_t rows,
                            const std::size_t columns, const float *x, float *y)
    {
      multiply(transposed, A, scale, rows, columns, x, y);
    }

    template <class Number>
    void product(const bool transposed, const bool plain, const Number *A, const float *scale,
                 const std::size_t rows, const std::size_t columns, const float *x, float *y)
    {
      is_wide && !plain ? wide(transposed, A, scale, rows, columns, x, y)
                        : multiply(transposed, A, scale, rows, columns, x, y);
    }
  } // namespace

  CompactMatrix::CompactMatrix(const std::vector<double> &A, const std::size_t n_rows, const bool compact)
      : n_rows(n_rows), n_columns(n_rows == 0 ? 0 : A.size() / n_rows),
        scale(n_blocks(n_rows) * n_blocks(n_columns), 0.f)
  {
    (compact ? integers.resize(size * scale.size()) : floats.resize(size * scale.size()));
    for (const double entry : A)
      largest = std::isfinite(entry) ? std::max(largest, std::abs(entry))
                                     : std::numeric_limits<double>::quiet_NaN();
    if (!compact)
      std::fill(scale.begin(), scale.end(), 1.f);
    const auto for_entries = [&](const auto &action)
    {
      for (std::size_t j = 0; j < n_columns && largest > 0.; ++j) // products with NaN give NaN
        for (std::size_t i = 0; i < n_rows; ++i)
          action(position(i, j), A[j * n_rows + i] / largest);
    };
    if (compact)
      for_entries(
          [&](const std::size_t at, const double value)
          {
            float &of_block = scale[at / size];
            of_block = std::max(of_block, static_cast<float>(std::abs(value) / most));
          });
    for_entries(
        [&](const std::size_t at, const double value)
        {
          const double of_block = scale[at / size];
          if (!compact)
            floats[at] = static_cast<float>(value);
          else if (of_block > 0.)
            integers[at] =
                static_cast<std::int16_t>(std::clamp(std::nearbyint(value / of_block), -most, most));
        });
  }

  std::size_t CompactMatrix::position(const std::size_t row, const std::size_t column) const
  {
    const std::size_t block = column / width * n_blocks(n_rows) + row / width;
    return width * (width * block + column % width) + row % width;
  }

  float CompactMatrix::operator()(const std::size_t row, const std::size_t column) const
  {
    const std::size_t at = position(row, column);
    return static_cast<float>(largest * scale[at / size] * (integers.empty() ? floats[at] : integers[at]));
  }

  std::vector<float> CompactMatrix::by_column() const
  {
    std::vector<float> A(n_rows * n_columns);
    for (std::size_t j = 0; j < n_columns; ++j)
      for (std::size_t i = 0; i < n_rows; ++i)
        A[j * n_rows + i] = (*this)(i, j);
    return A;
  }

  void CompactMatrix::multiply(const bool transposed, const bool plain, const float *x, float *y) const
  {
    if (empty())
      return;
    const std::size_t  n_in = transposed ? n_rows : n_columns, n_out = transposed ? n_columns : n_rows;
    std::vector<float> in(width * n_blocks(n_in), 0.f), out(y, y + n_out); // complete blocks
    for (std::size_t i = 0; i < n_in; ++i)
      in[i] = static_cast<float>(largest * x[i]);
    out.resize(width * n_blocks(n_out), 0.f);
    const auto add_product = [&](const auto &A)
    {
      product(transposed, plain, A.data(), scale.data(), n_blocks(n_rows), n_blocks(n_columns), in.data(),
              out.data());
    };
    integers.empty() ? add_product(floats) : add_product(integers);
    std::memcpy(y, out.data(), n_out * sizeof(float));
  }

  void CompactMatrix::add(const float *x, float *y, const bool plain) const
  {
    multiply(false, plain, x, y);
  }

  void CompactMatrix::add_transposed(const float *x, float *y, const bool plain) const
  {
    multiply(true, plain, x, y);
  }
} // namespace Voussoir
