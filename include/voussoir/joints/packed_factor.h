// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_packed_factor_h
#define voussoir_packed_factor_h

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <vector>

struct cholmod_factor_struct;

namespace Voussoir
{
  /** Leading columns of a supernodal Cholesky factor L, packed for substitutions at the speed of the memory.
   *
   * Panels of four columns lie one behind the other in the order in which they are used, in rows of eight,
   * the width of the widest SIMD registers; their triangles, with inverted diagonals, come before them. The
   * kernels are compiled for AVX-512, AVX and plain x86-64, and chosen when the program starts. */
  class PackedFactor
  {
  public:
    PackedFactor() = default;

    /** The first @p n_columns of the supernodal factor @p L, whose numbers are gone afterwards: a large
     * factor is packed where it is, so that there are never two of it. */
    PackedFactor(cholmod_factor_struct *L, std::size_t n_columns);

    /** The columns' part of x = L^-1 x, and what it does to the rows below; @p x: all rows, in the order of
     * L.
     */
    void forward(double *x) const;

    /** The columns' part of x = L^-T x; the rows below are given. */
    void backward(double *x) const;

    double memory() const; ///< [bytes]

    /** The kernels for processors without AVX, on any: for tests. Not to be changed while others solve. */
    static bool plain_kernels;

    /** Columns of L that belong together: the rows below them are the same. */
    struct Supernode
    {
      unsigned int first, n_columns, n_rows; ///< n_rows: the columns' own included
      std::size_t  rows;                     ///< of those below in PackedFactor::row_list
      std::size_t  values;                   ///< in PackedFactor::values
    };

  private:
    struct Free
    {
      void operator()(double *x) const { std::free(x); }
    };
    using Aligned = std::unique_ptr<double[], Free>; ///< to 64 bytes
    static Aligned allocate(std::size_t n);
    void           pack(const Supernode &supernode, const double *L, std::size_t leading_dimension);
    bool           pack_in_place(cholmod_factor_struct *L);

    std::vector<Supernode>    supernodes;
    std::vector<unsigned int> row_list;
    std::size_t               n_values = 0;
    Aligned                   values;
    double                   *first_value = nullptr; ///< of values, at a multiple of 64 bytes
    Aligned                   work;                  ///< the rows of one supernode
  };
} // namespace Voussoir

#endif
