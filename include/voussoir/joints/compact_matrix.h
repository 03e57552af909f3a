// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_compact_matrix_h
#define voussoir_compact_matrix_h

#include <cstddef>
#include <cstdint>
#include <vector>

namespace Voussoir
{
  /** Matrix in single precision for products. A compact matrix has two bytes per entry: integers, and a scale for
   * each block of 8 x 8 entries. The error of an entry is at most about 2^-16 of the largest one in its block. Entries
   * are stored relative to the largest one of the matrix, so units have no effect.
   *
   * Products read the matrix in sequence. It is rarely in the cache, so the number of bytes determines the time.
   * The matrix is stored in panels of eight columns, a panel in blocks of eight rows, and a block by column. Blocks
   * at the edges are filled with zeros. */
  class CompactMatrix
  {
  public:
    /** Creates an empty matrix. */
    CompactMatrix() = default;

    /** Copies a matrix with @p n_rows rows, by column. Its entries must be in the range of single precision.
     * @param compact two instead of four bytes per entry */
    CompactMatrix(const std::vector<double> &A, std::size_t n_rows, bool compact);

    /** Returns whether the matrix has no entries. */
    bool empty() const { return n_columns == 0; }

    /** Computes y += A x. @p plain: as on a processor without AVX2. */
    void add(const float *x, float *y, bool plain = false) const;

    /** Computes y += A^T x. */
    void add_transposed(const float *x, float *y, bool plain = false) const;

    /** Returns all entries by column. */
    std::vector<float> by_column() const;

    /** Returns an entry. */
    float operator()(std::size_t row, std::size_t column) const;

    /** Returns the memory consumption [bytes]. */
    double memory() const { return 4. * scale.size() + 4. * floats.size() + 2. * integers.size(); }

  private:
    std::size_t position(std::size_t row, std::size_t column) const;

    void multiply(bool transposed, bool plain, const float *x, float *y) const;

    std::size_t               n_rows = 0, n_columns = 0;
    double                    largest = 0.; ///< absolute value of an entry
    std::vector<float>        scale;        ///< of each block
    std::vector<float>        floats;       ///< entries of a matrix that is not compact
    std::vector<std::int16_t> integers;     ///< entries of a compact matrix
  };
} // namespace Voussoir

#endif
