// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/simd.h>
#include <voussoir/joints/packed_kernels.h>

#include <type_traits>

// One binary serves all processors: the widest kernels that the processor supports are selected when the
// program starts. The kernels for AVX-512 have their own packs; elsewhere GCC stores packs wider than 32
// bytes in memory.
#define VOUSSOIR_AVX512 __attribute__((target("avx512f")))
#define VOUSSOIR_CLONES __attribute__((target_clones("fma", "avx", "default")))

namespace Voussoir
{
  namespace
  {
    constexpr std::size_t width = PackedSupernode::width;
    typedef double        Pack __attribute__((vector_size(8 * width)));
    typedef double        Half __attribute__((vector_size(4 * width)));
    typedef float         FloatPack __attribute__((vector_size(4 * width)));
    typedef float         FloatHalf __attribute__((vector_size(2 * width)));

    template <class P> VOUSSOIR_INLINE const P &load(const double *x)
    {
      return *reinterpret_cast<const P *>(x);
    }

    template <class P> VOUSSOIR_INLINE P load(const float *x)
    {
      using Floats = std::conditional_t<sizeof(P) == sizeof(Pack), FloatPack, FloatHalf>;
      return __builtin_convertvector(*reinterpret_cast<const Floats *>(x), P);
    }

    template <class P> constexpr std::size_t lanes = sizeof(P) / 8;
    template <class P> constexpr std::size_t parts = width / lanes<P>; ///< packs per eight rows

    /** Computes t = M t for a panel of @p n columns. @p t: from the first row of the panel on. */
    template <class P, std::size_t n, class Number>
    VOUSSOIR_INLINE void forward_panel(const Number *M, const std::size_t n_rows, double *t)
    {
      double y[n];
      for (std::size_t j = 0; j < n; ++j)
        y[j] = t[j];
      for (std::size_t row = 0; row < n_rows; row += width, M += n * width)
      {
        prefetch(M, 8192, n * width * sizeof(Number));
        for (std::size_t part = 0; part < parts<P>; ++part)
        {
          const std::size_t first = part * lanes<P>;
          P                &out = *reinterpret_cast<P *>(t + row + first);
          P                 even = load<P>(M + first) * y[0], odd = {};
          for (std::size_t j = 1; j < n; ++j)
            (j % 2 == 1 ? odd : even) += load<P>(M + j * width + first) * y[j];
          P before = out;
          if (row == 0) // y has the old values of the rows of the panel
            for (std::size_t i = 0; i < lanes<P>; ++i)
              if (first + i < n)
                before[i] = 0.;
          out = before + (even + odd);
        }
      }
    }

    /** Stores the sums of the eight lanes of each of @p s. Lanes are added four to four first, in the same
     * order for all packs. */
    VOUSSOIR_INLINE void add_lanes(const Pack (&s)[width][1], double *sums)
    {
      Pack of_two[4], of_four[2];
      for (std::size_t k = 0; k < 4; ++k)
        of_two[k] = VOUSSOIR_SHUFFLE(s[2 * k][0], s[2 * k + 1][0], 0, 1, 2, 3, 8, 9, 10, 11) +
                    VOUSSOIR_SHUFFLE(s[2 * k][0], s[2 * k + 1][0], 4, 5, 6, 7, 12, 13, 14, 15);
      for (std::size_t k = 0; k < 2; ++k)
        of_four[k] = VOUSSOIR_SHUFFLE(of_two[2 * k], of_two[2 * k + 1], 0, 1, 4, 5, 8, 9, 12, 13) +
                     VOUSSOIR_SHUFFLE(of_two[2 * k], of_two[2 * k + 1], 2, 3, 6, 7, 10, 11, 14, 15);
      *reinterpret_cast<Pack *>(sums) = VOUSSOIR_SHUFFLE(of_four[0], of_four[1], 0, 2, 4, 6, 8, 10, 12, 14) +
                                        VOUSSOIR_SHUFFLE(of_four[0], of_four[1], 1, 3, 5, 7, 9, 11, 13, 15);
    }

    VOUSSOIR_INLINE void add_lanes(const Half (&s)[width][2], double *sums)
    {
      for (std::size_t k = 0; k < width; k += 4)
      {
        const Half first = s[k][0] + s[k][1], second = s[k + 1][0] + s[k + 1][1],
                   third = s[k + 2][0] + s[k + 2][1], fourth = s[k + 3][0] + s[k + 3][1],
                   left = VOUSSOIR_SHUFFLE(first, second, 0, 1, 4, 5) +
                          VOUSSOIR_SHUFFLE(first, second, 2, 3, 6, 7),
                   right = VOUSSOIR_SHUFFLE(third, fourth, 0, 1, 4, 5) +
                           VOUSSOIR_SHUFFLE(third, fourth, 2, 3, 6, 7);
        *reinterpret_cast<Half *>(sums + k) =
            VOUSSOIR_SHUFFLE(left, right, 0, 2, 4, 6) + VOUSSOIR_SHUFFLE(left, right, 1, 3, 5, 7);
      }
    }

    /** Computes the rows of the panel in t = M^T t. */
    template <class P, std::size_t n, class Number>
    VOUSSOIR_INLINE void backward_panel(const Number *M, const std::size_t n_rows, double *t)
    {
      P sums[width][parts<P>] = {};
      // The next panel is stored before this one, and is one block longer.
      const std::ptrdiff_t back = sizeof(Number) * width * (n_rows + width);
      for (std::size_t row = 0; row < n_rows; row += width, M += n * width)
      {
        prefetch(M, -back, n * width * sizeof(Number));
        for (std::size_t part = 0; part < parts<P>; ++part)
        {
          const P x = load<P>(t + row + part * lanes<P>);
          for (std::size_t j = 0; j < n; ++j)
            sums[j][part] += x * load<P>(M + j * width + part * lanes<P>);
        }
      }
      alignas(64) double y[width];
      add_lanes(sums, y);
      for (std::size_t j = 0; j < n; ++j)
        t[j] = y[j];
    }

    template <class P, class Number>
    VOUSSOIR_INLINE void panel(const bool forward, const std::size_t n, const Number *M,
                               const std::size_t n_rows, double *t)
    {
      switch (n)
      {
#define VOUSSOIR_PANEL(m)                                                                                    \
  case m:                                                                                                    \
    forward ? forward_panel<P, m>(M, n_rows, t) : backward_panel<P, m>(M, n_rows, t);                        \
    break;
        VOUSSOIR_PANEL(1)
        VOUSSOIR_PANEL(2)
        VOUSSOIR_PANEL(3)
        VOUSSOIR_PANEL(4)
        VOUSSOIR_PANEL(5)
        VOUSSOIR_PANEL(6)
        VOUSSOIR_PANEL(7)
        VOUSSOIR_PANEL(8)
#undef VOUSSOIR_PANEL
      }
    }

    VOUSSOIR_INLINE void gather(const PackedSupernode &s, const unsigned int *rows, const double *x,
                                double *t)
    {
      for (unsigned int i = 0; i < s.n_columns; ++i)
        t[i] = x[s.first + i];
      for (unsigned int i = s.n_columns; i < s.n_rows; ++i)
        t[i] = x[rows[i - s.n_columns]];
      for (std::size_t i = s.n_rows; i < PackedSupernode::round_up(s.n_rows); ++i)
        t[i] = 0.;
    }

    template <class P, class Number>
    VOUSSOIR_INLINE void forward_supernode(const PackedSupernode &s, const unsigned int *rows,
                                           const Number *values, double *t, double *x)
    {
      gather(s, rows, x, t);
      for (std::size_t column = 0; column < s.n_columns; column += width)
      {
        const std::size_t n = s.panel_width(column);
        panel<P>(true, n, values, s.n_rows - column, t + column);
        values += s.panel_size(column);
      }
      for (unsigned int i = 0; i < s.n_columns; ++i)
        x[s.first + i] = t[i];
      for (unsigned int i = s.n_columns; i < s.n_rows; ++i)
        x[rows[i - s.n_columns]] = t[i];
    }

    /** Substitutes backward in one supernode. @p values: end of its values. */
    template <class P, class Number>
    VOUSSOIR_INLINE void backward_supernode(const PackedSupernode &s, const unsigned int *rows,
                                            const Number *values, double *t, double *x)
    {
      gather(s, rows, x, t);
      for (std::size_t column = PackedSupernode::round_up(s.n_columns); column > 0;)
      {
        column -= width;
        const std::size_t n = s.panel_width(column);
        values -= s.panel_size(column);
        panel<P>(false, n, values, s.n_rows - column, t + column);
      }
      for (unsigned int i = 0; i < s.n_columns; ++i)
        x[s.first + i] = t[i];
    }

    template <class P, class Number>
    VOUSSOIR_INLINE void substitute(const PackedColumns<Number> &L, const bool forward, double *x)
    {
      for (std::size_t i = 0; forward && i < L.n_supernodes; ++i)
        forward_supernode<P>(L.supernodes[i], L.rows + L.supernodes[i].rows,
                             L.values + L.supernodes[i].values, L.work, x);
      for (std::size_t i = forward ? 0 : L.n_supernodes; i-- > 0;)
        backward_supernode<P>(L.supernodes[i], L.rows + L.supernodes[i].rows,
                              i + 1 == L.n_supernodes ? L.end : L.values + L.supernodes[i + 1].values, L.work,
                              x);
    }

    VOUSSOIR_AVX512 void wide(const PackedColumns<double> &L, const bool forward, double *x)
    {
      substitute<Pack>(L, forward, x);
    }
    VOUSSOIR_AVX512 void wide(const PackedColumns<float> &L, const bool forward, double *x)
    {
      substitute<Pack>(L, forward, x);
    }
    VOUSSOIR_CLONES void fast(const PackedColumns<double> &L, const bool forward, double *x)
    {
      substitute<Half>(L, forward, x);
    }
    VOUSSOIR_CLONES void fast(const PackedColumns<float> &L, const bool forward, double *x)
    {
      substitute<Half>(L, forward, x);
    }

    const bool is_wide = __builtin_cpu_supports("avx512f");

    template <class Number>
    void choose(const PackedColumns<Number> &L, const bool forward, const bool plain, double *x)
    {
      if (plain)
        substitute<Half>(L, forward, x);
      else if (is_wide)
        wide(L, forward, x);
      else
        fast(L, forward, x);
    }
  } // namespace

  void substitute(const PackedColumns<double> &L, const bool forward, const bool plain, double *x)
  {
    choose(L, forward, plain, x);
  }

  void substitute(const PackedColumns<float> &L, const bool forward, const bool plain, double *x)
  {
    choose(L, forward, plain, x);
  }
} // namespace Voussoir
