// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_packed_factor_h
#define voussoir_packed_factor_h

#include <voussoir/joints/packed_kernels.h>

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <vector>

struct cholmod_factor_struct;

namespace Voussoir
{
  /** Leading columns of a supernodal Cholesky factor L, packed for substitutions at the speed of the memory.
   *
   * Of each panel of eight columns, with the triangle D and the rows B below, M = (D^-1; -B D^-1) is kept: a
   * forward substitution is the product M t, a backward one M^T t, without a chain of divisions. Panels lie
   * one behind the other in the order in which they are used, in blocks of eight rows, the width of the
   * widest SIMD registers. The kernels are compiled for AVX-512, AVX and plain x86-64, and chosen when the
   * program starts. In single precision only M is kept so, which halves what is read; all arithmetic is in
   * double precision. */
  class PackedFactor
  {
  public:
    PackedFactor() = default;

    /** The first @p n_columns of the supernodal factor @p L, whose numbers are gone afterwards: a large
     * factor is packed where it is, so that there are never two of it. */
    PackedFactor(cholmod_factor_struct *L, std::size_t n_columns, bool single);

    /** The columns' part of x = L^-1 x, and what it does to the rows below; @p x: all rows, in the order of
     * L.
     */
    void forward(double *x) const;

    /** The columns' part of x = L^-T x; the rows below are given. */
    void backward(double *x) const;

    double memory() const; ///< [bytes]

    /** The kernels for processors without AVX, on any: for tests. Not to be changed while others solve. */
    static bool plain_kernels;

  private:
    struct Free
    {
      void operator()(void *x) const { std::free(x); }
    };
    using Aligned = std::unique_ptr<void, Free>; ///< to 64 bytes
    static Aligned               allocate(std::size_t bytes);
    template <class Number> void take(cholmod_factor_struct *L);
    template <class Number> bool pack_in_place(cholmod_factor_struct *L);
    template <class Number> void pack(const PackedSupernode &supernode, const double *L);
    template <class Number> void substitute_with(bool forward, double *x) const;

    bool                         is_single = false; ///< are the values floats?
    std::vector<PackedSupernode> supernodes;
    std::vector<unsigned int>    row_list;
    std::size_t                  n_values = 0;
    Aligned                      values;
    void                        *first_value = nullptr; ///< of values, at a multiple of 64 bytes
    Aligned                      work;                  ///< the rows of one supernode, doubles
  };
} // namespace Voussoir

#endif
