// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_packed_kernels_h
#define voussoir_packed_kernels_h

#include <cstddef>

namespace Voussoir
{
  /** Supernode: columns of a Cholesky factor with the same rows below. Its panels of eight columns
   * (PackedFactor) are stored one after the other. */
  struct PackedSupernode
  {
    static constexpr std::size_t width = 8; ///< rows and columns of a block

    unsigned int first, n_columns, n_rows; ///< n_rows includes the rows of the columns themselves
    std::size_t  rows;                     ///< begin of the rows below in PackedColumns::rows
    std::size_t  values;                   ///< begin in PackedColumns::values

    /** Returns the number of columns of the panel that begins at @p column, a multiple of eight. */
    unsigned int panel_width(const std::size_t column) const
    {
      return n_columns - column < width ? n_columns - column : width;
    }

    /** Returns the number of values of this panel. */
    std::size_t panel_size(const std::size_t column) const
    {
      return panel_width(column) * (round_up(n_rows) - column);
    }

    /** Returns @p n rounded up to a multiple of eight. */
    static std::size_t round_up(const std::size_t n) { return (n + width - 1) / width * width; }
  };

  /** Data of a substitution. Number: double or float. */
  template <class Number> struct PackedColumns
  {
    const PackedSupernode *supernodes;
    std::size_t            n_supernodes;
    const unsigned int    *rows;
    const Number          *values, *end; ///< aligned to 64 bytes
    double                *work;         ///< rows of the longest supernode, rounded up, aligned to 64 bytes
  };

  /** Performs PackedFactor::forward() or PackedFactor::backward(). @p plain: kernels for
   * processors without AVX. */
  void substitute(const PackedColumns<double> &L, bool forward, bool plain, double *x);
  void substitute(const PackedColumns<float> &L, bool forward, bool plain, double *x);
} // namespace Voussoir

#endif
