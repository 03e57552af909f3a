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
  /** Leading columns of a supernodal Cholesky factor L, stored for substitutions that are limited by memory
   * bandwidth only.
   *
   * Each panel of eight columns, with the triangle D and the rows B below, is stored as M = (D^-1; -B D^-1).
   * A forward substitution is the product M t, a backward substitution the product M^T t, without a chain of
   * divisions. Panels are stored in the order of use, in blocks of eight rows, the width of the widest SIMD
   * registers. Kernels for AVX-512, AVX and plain x86-64 are compiled; the program selects one
   * when it starts.
   *
   * Single precision halves the memory traffic. All arithmetic is in double precision. */
  class PackedFactor
  {
  public:
    PackedFactor() = default;

    /** Takes the first @p n_columns columns of the supernodal factor @p L, whose values are lost. A large
     * factor is packed in place, so that memory never holds two copies. */
    PackedFactor(cholmod_factor_struct *L, std::size_t n_columns, bool single);

    /** Computes the part of the columns in x = L^-1 x, and its effect on the rows below. @p x: all rows, in
     * the order of L. */
    void forward(double *x) const;

    /** Computes the part of the columns in x = L^-T x. The rows below are given. */
    void backward(double *x) const;

    double memory() const; ///< memory consumption [bytes]

    /** Selects the kernels for processors without AVX, for tests. Do not change it while
     * another thread solves. */
    static bool plain_kernels;

  private:
    struct Free
    {
      void operator()(void *x) const { std::free(x); }
    };
    using Aligned = std::unique_ptr<void, Free>; ///< aligned to 64 bytes
    static Aligned               allocate(std::size_t bytes);
    template <class Number> void take(cholmod_factor_struct *L);
    template <class Number> bool pack_in_place(cholmod_factor_struct *L);
    template <class Number> void pack(const PackedSupernode &supernode, const double *L);
    template <class Number> void substitute_with(bool forward, double *x) const;

    bool                         is_single = false; ///< values are floats
    std::vector<PackedSupernode> supernodes;
    std::vector<unsigned int>    row_list;
    std::size_t                  n_values = 0;
    Aligned                      values;
    void                        *first_value = nullptr; ///< first of the values, aligned to 64 bytes
    Aligned                      work;                  ///< rows of one supernode, in double precision
  };
} // namespace Voussoir

#endif
