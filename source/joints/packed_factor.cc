// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/joints/packed_factor.h>

#include <cholmod.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <new>

// One binary for all processors: the widest kernels that the processor has are chosen when it starts. Those
// of AVX-512 have packs of their own: elsewhere GCC keeps what is wider than 32 bytes in memory.
#define VOUSSOIR_AVX512 __attribute__((target("avx512f")))
#define VOUSSOIR_CLONES __attribute__((target_clones("fma", "avx", "default")))
#define VOUSSOIR_INLINE inline __attribute__((always_inline))

namespace Voussoir
{
  namespace
  {
    constexpr std::size_t width = 8; // rows
    constexpr std::size_t triangle =
        16; // numbers: up to six below the diagonal, four inverted ones from 8 on
    typedef double Pack __attribute__((vector_size(8 * width)));
    typedef double Half __attribute__((vector_size(4 * width)));

    std::size_t round_down(const std::size_t n)
    {
      return n / width * width;
    }
    std::size_t round_up(const std::size_t n)
    {
      return (n + width - 1) / width * width;
    }

    /** Numbers that the panel of @p n columns from @p column of a supernode takes: rows from the first whole
     * pack that it needs. */
    std::size_t panel_size(const std::size_t n_rows, const std::size_t column, const std::size_t n)
    {
      return triangle + n * (round_up(n_rows) - round_down(column + n));
    }

    std::size_t panel_width(const std::size_t n_columns, const std::size_t column)
    {
      return std::min<std::size_t>(4, n_columns - column);
    }

    template <class P> VOUSSOIR_INLINE const P &load(const double *x)
    {
      return *reinterpret_cast<const P *>(x);
    }

    /** @p t: rows of the supernode; @p column: first one of the panel, of @p n columns. */
    template <class P, std::size_t n>
    VOUSSOIR_INLINE void forward_panel(const double *panel, const std::size_t column,
                                       const std::size_t n_rows, double *t)
    {
      double y[n];
      for (std::size_t i = 0; i < n; ++i)
      {
        double sum = t[column + i];
        for (std::size_t j = 0; j < i; ++j)
          sum -= panel[i * (i - 1) / 2 + j] * y[j];
        t[column + i] = y[i] = sum * panel[8 + i];
      }
      const std::size_t begin = round_down(column + n), height = round_up(n_rows) - begin;
      const double     *L = panel + triangle;
      for (std::size_t i = 0; i < height; i += sizeof(P) / 8)
      {
        P &below = *reinterpret_cast<P *>(t + begin + i);
        P  sum = below;
        for (std::size_t j = 0; j < n; ++j)
          sum -= y[j] * load<P>(L + j * height + i);
        below = sum;
      }
    }

    template <class P, std::size_t n>
    VOUSSOIR_INLINE void backward_panel(const double *panel, const std::size_t column,
                                        const std::size_t n_rows, double *t)
    {
      const std::size_t     begin = round_down(column + n), height = round_up(n_rows) - begin;
      const double         *L = panel + triangle;
      constexpr std::size_t lanes = sizeof(P) / 8, parts = width / lanes; // the same sums for all packs
      P                     sums[n][parts] = {};
      for (std::size_t i = 0; i < height; i += width)
        for (std::size_t part = 0; part < parts; ++part)
        {
          const P &x = load<P>(t + begin + i + part * lanes);
          for (std::size_t j = 0; j < n; ++j)
            sums[j][part] += x * load<P>(L + j * height + i + part * lanes);
        }
      for (std::size_t i = n; i-- > 0;)
      {
        double sum = t[column + i];
        for (std::size_t k = 0; k < width; ++k)
          sum -= sums[i][k / lanes][k % lanes];
        for (std::size_t j = i + 1; j < n; ++j)
          sum -= panel[j * (j - 1) / 2 + i] * t[column + j];
        t[column + i] = sum * panel[8 + i];
      }
    }

    using Supernode = PackedFactor::Supernode;

    VOUSSOIR_INLINE void gather(const Supernode &s, const unsigned int *rows, const double *x, double *t)
    {
      for (unsigned int i = 0; i < s.n_columns; ++i)
        t[i] = x[s.first + i];
      for (unsigned int i = s.n_columns; i < s.n_rows; ++i)
        t[i] = x[rows[i - s.n_columns]];
      for (std::size_t i = s.n_rows; i < round_up(s.n_rows); ++i)
        t[i] = 0.;
    }

    template <class P>
    VOUSSOIR_INLINE void forward_supernode(const Supernode &s, const unsigned int *rows, const double *values,
                                           double *t, double *x)
    {
      gather(s, rows, x, t);
      for (std::size_t column = 0; column < s.n_columns;)
      {
        const std::size_t n = panel_width(s.n_columns, column);
        if (n == 4)
          forward_panel<P, 4>(values, column, s.n_rows, t);
        else if (n == 3)
          forward_panel<P, 3>(values, column, s.n_rows, t);
        else if (n == 2)
          forward_panel<P, 2>(values, column, s.n_rows, t);
        else
          forward_panel<P, 1>(values, column, s.n_rows, t);
        values += round_up(panel_size(s.n_rows, column, n));
        column += n;
      }
      for (unsigned int i = 0; i < s.n_columns; ++i)
        x[s.first + i] = t[i];
      for (unsigned int i = s.n_columns; i < s.n_rows; ++i)
        x[rows[i - s.n_columns]] = t[i];
    }

    /** @p values: the end of the supernode's. */
    template <class P>
    VOUSSOIR_INLINE void backward_supernode(const Supernode &s, const unsigned int *rows,
                                            const double *values, double *t, double *x)
    {
      gather(s, rows, x, t);
      for (std::size_t column = s.n_columns; column > 0;)
      {
        const std::size_t n = column % 4 == 0 ? 4 : column % 4;
        column -= n;
        values -= round_up(panel_size(s.n_rows, column, n));
        if (n == 4)
          backward_panel<P, 4>(values, column, s.n_rows, t);
        else if (n == 3)
          backward_panel<P, 3>(values, column, s.n_rows, t);
        else if (n == 2)
          backward_panel<P, 2>(values, column, s.n_rows, t);
        else
          backward_panel<P, 1>(values, column, s.n_rows, t);
      }
      for (unsigned int i = 0; i < s.n_columns; ++i)
        x[s.first + i] = t[i];
    }

    struct Factor ///< as the kernels see it
    {
      const Supernode    *supernodes;
      std::size_t         n_supernodes;
      const unsigned int *rows;
      const double       *values, *end;
      double             *work;
    };

    template <class P> VOUSSOIR_INLINE void forward_all(const Factor &L, double *x)
    {
      for (std::size_t i = 0; i < L.n_supernodes; ++i)
        forward_supernode<P>(L.supernodes[i], L.rows + L.supernodes[i].rows,
                             L.values + L.supernodes[i].values, L.work, x);
    }

    template <class P> VOUSSOIR_INLINE void backward_all(const Factor &L, double *x)
    {
      for (std::size_t i = L.n_supernodes; i-- > 0;)
        backward_supernode<P>(L.supernodes[i], L.rows + L.supernodes[i].rows,
                              i + 1 == L.n_supernodes ? L.end : L.values + L.supernodes[i + 1].values, L.work,
                              x);
    }

    VOUSSOIR_AVX512 void forward_wide(const Factor &L, double *x)
    {
      forward_all<Pack>(L, x);
    }
    VOUSSOIR_CLONES void forward_fast(const Factor &L, double *x)
    {
      forward_all<Half>(L, x);
    }
    VOUSSOIR_AVX512 void backward_wide(const Factor &L, double *x)
    {
      backward_all<Pack>(L, x);
    }
    VOUSSOIR_CLONES void backward_fast(const Factor &L, double *x)
    {
      backward_all<Half>(L, x);
    }
    void forward_plain(const Factor &L, double *x)
    {
      forward_all<Half>(L, x);
    }
    void backward_plain(const Factor &L, double *x)
    {
      backward_all<Half>(L, x);
    }
  } // namespace

  bool PackedFactor::plain_kernels = false;

  namespace
  {
    const bool is_wide = __builtin_cpu_supports("avx512f");
  } // namespace

  PackedFactor::Aligned PackedFactor::allocate(const std::size_t n)
  {
    const std::size_t bytes = 8 * std::max(width, round_up(n));
    auto             *x = static_cast<double *>(std::aligned_alloc(8 * width, bytes));
    if (!x)
      throw std::bad_alloc();
    std::memset(x, 0, bytes);
    return Aligned(x);
  }

  PackedFactor::PackedFactor(cholmod_factor_struct *L, const std::size_t n_columns)
  {
    const int *super = static_cast<const int *>(L->super), *pi = static_cast<const int *>(L->pi),
              *px = static_cast<const int *>(L->px), *s = static_cast<const int *>(L->s);
    std::size_t most_rows = 0;
    for (std::size_t i = 0; i < L->nsuper && static_cast<std::size_t>(super[i]) < n_columns; ++i)
    {
      Supernode node;
      node.first = super[i];
      node.n_columns = std::min<std::size_t>(super[i + 1], n_columns) - node.first;
      node.n_rows = pi[i + 1] - pi[i];
      node.rows = row_list.size();
      node.values = n_values;
      row_list.insert(row_list.end(), s + pi[i] + node.n_columns, s + pi[i + 1]);
      for (std::size_t column = 0; column < node.n_columns; column += 4)
        n_values += round_up(panel_size(node.n_rows, column, panel_width(node.n_columns, column)));
      most_rows = std::max<std::size_t>(most_rows, node.n_rows);
      supernodes.push_back(node);
    }
    row_list.shrink_to_fit();
    supernodes.shrink_to_fit();
    work = allocate(most_rows);
    if (pack_in_place(L))
      return;
    values = allocate(n_values);
    first_value = values.get();
    for (std::size_t i = 0; i < supernodes.size(); ++i)
      pack(supernodes[i], static_cast<const double *>(L->x) + px[i], supernodes[i].n_rows);
  }

  /** Takes the numbers of @p L over and packs them where they are, if that is worth it and they fit. */
  bool PackedFactor::pack_in_place(cholmod_factor_struct *L)
  {
    constexpr std::size_t large = 1000000; // numbers
    constexpr std::size_t line = 8;        // numbers in 64 bytes
    const int            *px = static_cast<const int *>(L->px);
    std::size_t           shift = 0; // by which the numbers must be moved back, so that none is overwritten
    for (std::size_t i = 0; i < supernodes.size(); ++i)
    {
      const std::size_t packed_end = line + (i + 1 < supernodes.size() ? supernodes[i + 1].values : n_values),
                        end = px[i] + std::size_t(supernodes[i].n_rows) * supernodes[i].n_columns;
      shift = std::max(shift, packed_end - std::min(packed_end, end));
    }
    if (L->xsize < large || shift > L->xsize / 20)
      return false;
    auto *x = static_cast<double *>(std::realloc(L->x, 8 * (L->xsize + shift)));
    if (!x)
      return false;
    L->x = nullptr; // ours from now on
    values.reset(x);
    std::memmove(x + shift, x, 8 * L->xsize);
    first_value = x + (line - reinterpret_cast<std::uintptr_t>(x) / 8 % line) % line;
    std::vector<double> original;
    for (const Supernode &s : supernodes)
    {
      const double *from = x + shift + px[&s - supernodes.data()];
      original.assign(from, from + std::size_t(s.n_rows) * s.n_columns);
      pack(s, original.data(), s.n_rows);
    }
    // Such a block shrinks where it is; should it move all the same, its numbers must not be out of line.
    const std::size_t used = first_value - x + n_values, before = first_value - x;
    if (void *smaller = std::realloc(x, 8 * std::max<std::size_t>(used, 1)))
    {
      values.release(); // by realloc
      values.reset(static_cast<double *>(smaller));
    }
    first_value = values.get() + before;
    if (reinterpret_cast<std::uintptr_t>(first_value) % 64 != 0)
    {
      Aligned copy = allocate(n_values);
      std::copy_n(first_value, n_values, copy.get());
      values = std::move(copy);
      first_value = values.get();
    }
    return true;
  }

  void PackedFactor::pack(const Supernode &s, const double *L, const std::size_t leading_dimension)
  {
    double *panel = first_value + s.values;
    for (std::size_t column = 0; column < s.n_columns; column += 4)
    {
      const std::size_t n = panel_width(s.n_columns, column), begin = round_down(column + n),
                        height = round_up(s.n_rows) - begin, size = round_up(panel_size(s.n_rows, column, n));
      std::fill(panel, panel + size, 0.);
      for (std::size_t j = 0; j < n; ++j)
      {
        const double *from = L + (column + j) * leading_dimension;
        for (std::size_t i = j + 1; i < n; ++i)
          panel[i * (i - 1) / 2 + j] = from[column + i];
        panel[8 + j] = 1. / from[column + j];
        for (std::size_t row = column + n; row < s.n_rows; ++row)
          panel[triangle + j * height + row - begin] = from[row];
      }
      panel += size;
    }
  }

  void PackedFactor::forward(double *x) const
  {
    const Factor L = {supernodes.data(), supernodes.size(),      row_list.data(),
                      first_value,       first_value + n_values, work.get()};
    (plain_kernels ? forward_plain : is_wide ? forward_wide : forward_fast)(L, x);
  }

  void PackedFactor::backward(double *x) const
  {
    const Factor L = {supernodes.data(), supernodes.size(),      row_list.data(),
                      first_value,       first_value + n_values, work.get()};
    (plain_kernels ? backward_plain : is_wide ? backward_wide : backward_fast)(L, x);
  }

  double PackedFactor::memory() const
  {
    return 8. * n_values + 4. * row_list.size() + sizeof(Supernode) * supernodes.size();
  }
} // namespace Voussoir
