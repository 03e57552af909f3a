// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/joints/packed_factor.h>

#include <cholmod.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <new>

namespace Voussoir
{
  namespace
  {
    constexpr std::size_t width = PackedSupernode::width;
    typedef double        Pack __attribute__((vector_size(8 * width)));
  } // namespace

  bool PackedFactor::plain_kernels = false;

  PackedFactor::Aligned PackedFactor::allocate(const std::size_t bytes)
  {
    constexpr std::size_t line = 64;
    const std::size_t     size = std::max<std::size_t>(1, (bytes + line - 1) / line) * line;
    Aligned               x(std::aligned_alloc(line, size));
    if (!x)
      throw std::bad_alloc();
    std::memset(x.get(), 0, size);
    return x;
  }

  PackedFactor::PackedFactor(cholmod_factor_struct *L, const std::size_t n_columns, const bool single)
      : is_single(single)
  {
    const int *super = static_cast<const int *>(L->super), *pi = static_cast<const int *>(L->pi),
              *s = static_cast<const int *>(L->s);
    std::size_t most_rows = 0;
    for (std::size_t i = 0; i < L->nsuper && static_cast<std::size_t>(super[i]) < n_columns; ++i)
    {
      PackedSupernode node;
      node.first = super[i];
      node.n_columns = std::min<std::size_t>(super[i + 1], n_columns) - node.first;
      node.n_rows = pi[i + 1] - pi[i];
      node.rows = row_list.size();
      node.values = n_values;
      row_list.insert(row_list.end(), s + pi[i] + node.n_columns, s + pi[i + 1]);
      for (std::size_t column = 0; column < node.n_columns; column += width)
        n_values += node.panel_size(column);
      most_rows = std::max<std::size_t>(most_rows, node.n_rows);
      supernodes.push_back(node);
    }
    row_list.shrink_to_fit();
    supernodes.shrink_to_fit();
    work = allocate(8 * PackedSupernode::round_up(most_rows));
    single ? take<float>(L) : take<double>(L);
  }

  template <class Number> void PackedFactor::take(cholmod_factor_struct *L)
  {
    if (pack_in_place<Number>(L))
      return;
    const int *px = static_cast<const int *>(L->px);
    values = allocate(sizeof(Number) * n_values);
    first_value = values.get();
    for (std::size_t i = 0; i < supernodes.size(); ++i)
      pack<Number>(supernodes[i], static_cast<const double *>(L->x) + px[i]);
  }

  /** Takes the values of @p L and packs them in place, if the factor is large and the packed values fit.
   * Returns whether they are packed. */
  template <class Number> bool PackedFactor::pack_in_place(cholmod_factor_struct *L)
  {
    constexpr std::size_t large = 1000000; // values
    constexpr std::size_t line = 8;        // doubles in 64 bytes
    const int            *px = static_cast<const int *>(L->px);
    std::size_t           shift = 0; // shift of the values, so that none is overwritten before use
    for (std::size_t i = 0; i < supernodes.size(); ++i)
    {
      const std::size_t next = i + 1 < supernodes.size() ? supernodes[i + 1].values : n_values,
                        packed_end = line + (sizeof(Number) * next + 7) / 8,
                        end = px[i] + std::size_t(supernodes[i].n_rows) * supernodes[i].n_columns;
      shift = std::max(shift, packed_end - std::min(packed_end, end));
    }
    if (L->xsize < large || shift > L->xsize / 20)
      return false;
    auto *x = static_cast<double *>(std::realloc(L->x, 8 * (L->xsize + shift)));
    if (!x)
      return false;
    L->x = nullptr; // owned by this object from here on
    values.reset(x);
    std::memmove(x + shift, x, 8 * L->xsize);
    first_value = x + (line - reinterpret_cast<std::uintptr_t>(x) / 8 % line) % line;
    std::vector<double> original;
    for (const PackedSupernode &s : supernodes)
    {
      const double *from = x + shift + px[&s - supernodes.data()];
      original.assign(from, from + std::size_t(s.n_rows) * s.n_columns);
      pack<Number>(s, original.data());
    }
    // realloc() usually shrinks such a block in place. If it moves the block, the alignment
    // must be restored.
    const std::size_t bytes = sizeof(Number) * n_values,
                      before = static_cast<char *>(first_value) - reinterpret_cast<char *>(x);
    if (void *smaller = std::realloc(x, std::max<std::size_t>(before + bytes, 1)))
    {
      values.release(); // released by realloc()
      values.reset(smaller);
    }
    first_value = static_cast<char *>(values.get()) + before;
    if (reinterpret_cast<std::uintptr_t>(first_value) % 64 != 0)
    {
      Aligned copy = allocate(bytes);
      std::memcpy(copy.get(), first_value, bytes);
      values = std::move(copy);
      first_value = values.get();
    }
    return true;
  }

  /** Packs the panels of a supernode. @p L: its columns. */
  template <class Number> void PackedFactor::pack(const PackedSupernode &s, const double *L)
  {
    Number *panel = static_cast<Number *>(first_value) + s.values;
    for (std::size_t column = 0; column < s.n_columns; column += width)
    {
      const std::size_t n = s.panel_width(column);
      double            D[width][width] = {}; // inverse of the triangle of the panel
      const auto        at = [&](const std::size_t row, const std::size_t j)
      { return L[(column + j) * s.n_rows + row]; };
      for (std::size_t j = 0; j < n; ++j)
      {
        D[j][j] = 1. / at(column + j, j);
        for (std::size_t i = j + 1; i < n; ++i)
        {
          for (std::size_t k = j; k < i; ++k)
            D[i][j] -= at(column + i, k) * D[k][j];
          D[i][j] /= at(column + i, i);
        }
      }
      for (std::size_t row = column; row < s.n_rows; row += width)
      {
        Pack              below[width] = {}; // eight rows of L below the panel; zero beyond the last row
        const std::size_t end = std::min(width, s.n_rows - row);
        for (std::size_t k = 0; k < n; ++k)
          for (std::size_t i = row == column ? n : 0; i < end; ++i)
            below[k][i] = at(row + i, k);
        for (std::size_t j = 0; j < n; ++j)
        {
          Pack sum = {};
          for (std::size_t k = j; k < n; ++k)
            sum -= D[k][j] * below[k];
          for (std::size_t i = row == column ? j : n; i < n; ++i)
            sum[i] += D[i][j];
          for (std::size_t i = 0; i < width; ++i)
            panel[(row - column) * n + j * width + i] = static_cast<Number>(sum[i]);
        }
      }
      panel += s.panel_size(column);
    }
  }

  template <class Number> void PackedFactor::substitute_with(const bool forward, double *x) const
  {
    const auto                 *first = static_cast<const Number *>(first_value);
    const PackedColumns<Number> L = {supernodes.data(), supernodes.size(),
                                     row_list.data(),   first,
                                     first + n_values,  static_cast<double *>(work.get())};
    substitute(L, forward, plain_kernels, x);
  }

  void PackedFactor::forward(double *x) const
  {
    is_single ? substitute_with<float>(true, x) : substitute_with<double>(true, x);
  }

  void PackedFactor::backward(double *x) const
  {
    is_single ? substitute_with<float>(false, x) : substitute_with<double>(false, x);
  }

  double PackedFactor::memory() const
  {
    return (is_single ? 4. : 8.) * n_values + 4. * row_list.size() +
           sizeof(PackedSupernode) * supernodes.size();
  }
} // namespace Voussoir
