// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/simd.h>
#include <voussoir/joints/compact_matrix.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace Voussoir
{
  namespace
  {
    constexpr std::size_t width = 8;    // rows and columns of a block
    constexpr std::size_t more = width; // bytes read after the last block
    constexpr std::size_t ahead = 2048; // distance of the prefetch [bytes]
    typedef float         Pack __attribute__((vector_size(4 * width)));
    typedef std::uint32_t Bits __attribute__((vector_size(4 * width)));
    typedef unsigned char Bytes __attribute__((vector_size(4 * width)));
    const bool            is_wide = has_avx2();

    std::size_t n_blocks(const std::size_t n)
    {
      return (n + width - 1) / width;
    }

    /** Returns an entry of @p n_bytes bytes. The missing bytes are the lowest. */
    float value_of(const unsigned char *p, const std::size_t n_bytes)
    {
      std::uint32_t bits = 0;
      for (std::size_t k = 0; k < n_bytes; ++k)
        bits |= std::uint32_t(p[k]) << 8 * (4 - n_bytes + k);
      float value;
      std::memcpy(&value, &bits, sizeof(value));
      return value;
    }

    /** Columns of a block with three bytes per entry. Two shuffles decode a column: four entries to each half of
     * the pack, then each entry to the upper bytes of its lane. */
    struct Shuffled
    {
      static constexpr std::size_t n_bytes = 3;

      static VOUSSOIR_INLINE void load(const unsigned char *p, Pack &pack)
      {
        Bits bits;
        std::memcpy(&bits, p, sizeof(bits));
        const Bits  halves = VOUSSOIR_SHUFFLE(bits, bits, 0, 1, 2, 3, 3, 4, 5, 6);
        const Bytes bytes = (Bytes)halves;
        pack = (Pack)((Bits)VOUSSOIR_SHUFFLE(bytes, bytes, 0, 0, 1, 2, 3, 3, 4, 5, 6, 6, 7, 8, 9, 9, 10, 11,
                                             16, 16, 17, 18, 19, 19, 20, 21, 22, 22, 23, 24, 25, 25, 26, 27) &
                      0xffffff00u);
      }
    };

    /** The same for processors without these shuffles. */
    struct Plain
    {
      static constexpr std::size_t n_bytes = 3;

      static VOUSSOIR_INLINE void load(const unsigned char *p, Pack &pack)
      {
        for (std::size_t i = 0; i < width; ++i)
          pack[i] = value_of(p + n_bytes * i, n_bytes);
      }
    };

    /** Columns with four bytes per entry. */
    struct Complete
    {
      static constexpr std::size_t n_bytes = 4;

      static VOUSSOIR_INLINE void load(const unsigned char *p, Pack &pack)
      {
        std::memcpy(&pack, p, sizeof(pack));
      }
    };

    /** Computes y += A x. @p rows, @p columns: numbers of blocks. */
    template <class Decoder>
    VOUSSOIR_INLINE void add(const unsigned char *A, const std::size_t rows, const std::size_t columns,
                             const float *x, float *y)
    {
      constexpr std::size_t stride = Decoder::n_bytes * width, size = stride * width;
      for (std::size_t c = 0; c < columns; ++c, x += width)
        for (std::size_t r = 0; r < rows; ++r, A += size)
        {
          prefetch(A, ahead, size);
          Pack even, odd = {}, a;
          std::memcpy(&even, y + width * r, sizeof(Pack));
          for (std::size_t k = 0; k < width; k += 2)
          {
            Decoder::load(A + stride * k, a);
            even += x[k] * a;
            Decoder::load(A + stride * (k + 1), a);
            odd += x[k + 1] * a;
          }
          even += odd;
          std::memcpy(y + width * r, &even, sizeof(Pack));
        }
    }

    /** Computes y += A^T x. */
    template <class Decoder>
    VOUSSOIR_INLINE void add_transposed(const unsigned char *A, const std::size_t rows,
                                        const std::size_t columns, const float *x, float *y)
    {
      constexpr std::size_t stride = Decoder::n_bytes * width, size = stride * width;
      for (std::size_t c = 0; c < columns; ++c, y += width)
      {
        Pack sums[width] = {};
        for (std::size_t r = 0; r < rows; ++r, A += size)
        {
          prefetch(A, ahead, size);
          Pack x_r, a;
          std::memcpy(&x_r, x + width * r, sizeof(Pack));
          for (std::size_t k = 0; k < width; ++k)
          {
            Decoder::load(A + stride * k, a);
            sums[k] += x_r * a;
          }
        }
        for (std::size_t k = 0; k < width; ++k)
          y[k] += ((sums[k][0] + sums[k][1]) + (sums[k][2] + sums[k][3])) +
                  ((sums[k][4] + sums[k][5]) + (sums[k][6] + sums[k][7]));
      }
    }

    template <class Decoder>
    VOUSSOIR_INLINE void multiply(const bool transposed, const unsigned char *A, const std::size_t rows,
                                  const std::size_t columns, const float *x, float *y)
    {
      transposed ? add_transposed<Decoder>(A, rows, columns, x, y) : add<Decoder>(A, rows, columns, x, y);
    }

    VOUSSOIR_AVX2 void wide_3(const bool transposed, const unsigned char *A, const std::size_t rows,
                              const std::size_t columns, const float *x, float *y)
    {
      multiply<Shuffled>(transposed, A, rows, columns, x, y);
    }

    VOUSSOIR_AVX2 void wide_4(const bool transposed, const unsigned char *A, const std::size_t rows,
                              const std::size_t columns, const float *x, float *y)
    {
      multiply<Complete>(transposed, A, rows, columns, x, y);
    }

    void plain_3(const bool transposed, const unsigned char *A, const std::size_t rows,
                 const std::size_t columns, const float *x, float *y)
    {
      multiply<Plain>(transposed, A, rows, columns, x, y);
    }

    void plain_4(const bool transposed, const unsigned char *A, const std::size_t rows,
                 const std::size_t columns, const float *x, float *y)
    {
      multiply<Complete>(transposed, A, rows, columns, x, y);
    }
  } // namespace

  CompactMatrix::CompactMatrix(const std::vector<double> &A, const std::size_t n_rows, const bool compact)
      : n_rows(n_rows), n_columns(n_rows == 0 ? 0 : A.size() / n_rows), n_bytes(compact ? 3 : 4),
        bytes(empty() ? 0 : n_blocks(n_rows) * n_blocks(n_columns) * width * width * n_bytes + more, 0)
  {
    bool is_finite = true;
    for (const double entry : A)
    {
      largest = std::max(largest, std::abs(entry));
      is_finite = is_finite && std::isfinite(entry);
    }
    if (!is_finite) // products then give no numbers
      largest = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t j = 0; j < n_columns && largest > 0.; ++j)
      for (std::size_t i = 0; i < n_rows; ++i)
      {
        const float   value = static_cast<float>(A[j * n_rows + i] / largest);
        std::uint32_t bits;
        std::memcpy(&bits, &value, sizeof(bits));
        if (compact)
          bits += 0x7fu + (bits >> 8 & 1u); // to the nearest number; a tie to the even one
        for (std::size_t k = 0; k < n_bytes; ++k)
          bytes[position(i, j) + k] = static_cast<unsigned char>(bits >> 8 * (4 - n_bytes + k));
      }
  }

  std::size_t CompactMatrix::position(const std::size_t row, const std::size_t column) const
  {
    const std::size_t block = column / width * n_blocks(n_rows) + row / width;
    return n_bytes * (width * (width * block + column % width) + row % width);
  }

  float CompactMatrix::operator()(const std::size_t row, const std::size_t column) const
  {
    return static_cast<float>(largest * value_of(bytes.data() + position(row, column), n_bytes));
  }

  std::vector<float> CompactMatrix::by_column() const
  {
    std::vector<float>   A(n_rows * n_columns);
    const unsigned char *p = bytes.data();
    for (std::size_t c = 0; c < n_columns; c += width)
      for (std::size_t r = 0; r < n_rows; r += width)
        for (std::size_t j = c; j < c + width; ++j)
          for (std::size_t i = r; i < r + width; ++i, p += n_bytes)
            if (i < n_rows && j < n_columns)
              A[j * n_rows + i] = static_cast<float>(largest * value_of(p, n_bytes));
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
    const bool fast = is_wide && !plain;
    (n_bytes == 3 ? fast ? wide_3 : plain_3
     : fast
         ? wide_4
         : plain_4)(transposed, bytes.data(), n_blocks(n_rows), n_blocks(n_columns), in.data(), out.data());
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
