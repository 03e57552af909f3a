// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_packed_kernels_h
#define voussoir_packed_kernels_h

#include <cstddef>

namespace Voussoir
{
  /** Columns of a Cholesky factor that belong together: the rows below them are the same. Its panels of eight
   * columns, see PackedFactor, lie one behind the other. */
  struct PackedSupernode
  {
    static constexpr std::size_t width = 8; ///< rows and columns of a block

    unsigned int first, n_columns, n_rows; ///< n_rows: the columns' own included
    std::size_t  rows;                     ///< of those below, in PackedColumns::rows
    std::size_t  values;                   ///< in PackedColumns::values

    /** Columns of the panel that begins with @p column, a multiple of eight. */
    unsigned int panel_width(const std::size_t column) const
    {
      return n_columns - column < width ? n_columns - column : width;
    }

    /** Numbers that it takes. */
    std::size_t panel_size(const std::size_t column) const
    {
      return panel_width(column) * (round_up(n_rows) - column);
    }

    static std::size_t round_up(const std::size_t n) { return (n + width - 1) / width * width; }
  };

  /** What a substitution reads; @p Number: double or float. */
  template <class Number> struct PackedColumns
  {
    const PackedSupernode *supernodes;
    std::size_t            n_supernodes;
    const unsigned int    *rows;
    const Number          *values, *end; ///< at a multiple of 64 bytes
    double                *work; ///< the rows of the longest supernode, rounded up, at a multiple of 64 bytes
  };

  /** PackedFactor::forward() or backward(); @p plain: by the kernels for processors without AVX. */
  void substitute(const PackedColumns<double> &L, bool forward, bool plain, double *x);
  void substitute(const PackedColumns<float> &L, bool forward, bool plain, double *x);
} // namespace Voussoir

#endif
