// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/node_matrix.h>

#include <algorithm>
#include <cassert>

namespace Voussoir
{
  BlockSparseMatrix::BlockSparseMatrix(const std::vector<std::vector<unsigned int>> &columns)
  {
    start.reserve(columns.size() + 1);
    start.push_back(0);
    for (const auto &row : columns)
    {
      column.insert(column.end(), row.begin(), row.end());
      start.push_back(column.size());
    }
    value.assign(column.size(), Matrix3{});
  }

  void BlockSparseMatrix::add(const unsigned int row, const unsigned int col, const Matrix3 &block)
  {
    const auto begin = column.begin() + start[row], end = column.begin() + start[row + 1];
    const auto found = std::lower_bound(begin, end, col);
    assert(found != end && *found == col);
    Matrix3 &entry = value[found - column.begin()];
    for (unsigned int i = 0; i < 9; ++i)
      entry[i] += block[i];
  }

  void BlockSparseMatrix::extend(std::vector<std::vector<unsigned int>> more)
  {
    for (unsigned int row = 0; row < n_rows(); ++row)
    {
      more[row].insert(more[row].end(), column.begin() + start[row], column.begin() + start[row + 1]);
      std::sort(more[row].begin(), more[row].end());
      more[row].erase(std::unique(more[row].begin(), more[row].end()), more[row].end());
    }
    BlockSparseMatrix result(more);
    for (unsigned int row = 0; row < n_rows(); ++row)
      for (std::size_t k = start[row]; k < start[row + 1]; ++k)
        result.add(row, column[k], value[k]);
    *this = std::move(result);
  }

  void BlockSparseMatrix::multiply(const double *x, double *y) const
  {
    const int n = n_rows();
#pragma omp parallel for schedule(static)
    for (int row = 0; row < n; ++row)
    {
      double y0 = 0, y1 = 0, y2 = 0;
      for (std::size_t k = start[row]; k < start[row + 1]; ++k)
      {
        const double *a = value[k].data(), *p = x + 3 * column[k];
        y0 += a[0] * p[0] + a[1] * p[1] + a[2] * p[2];
        y1 += a[3] * p[0] + a[4] * p[1] + a[5] * p[2];
        y2 += a[6] * p[0] + a[7] * p[1] + a[8] * p[2];
      }
      y[3 * row] = y0, y[3 * row + 1] = y1, y[3 * row + 2] = y2;
    }
  }

  void BlockSparseMatrix::symmetrise()
  {
    for (unsigned int row = 0; row < n_rows(); ++row)
      for (std::size_t k = start[row]; k < start[row + 1]; ++k)
        if (column[k] >= row &&
            start[column[k]] < start[column[k] + 1]) // a part of a matrix may lack the row
        {
          const auto begin = column.begin() + start[column[k]], end = column.begin() + start[column[k] + 1];
          Matrix3   &a = value[k], &b = value[std::lower_bound(begin, end, row) - column.begin()];
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              a[3 * i + j] = b[3 * j + i] = .5 * (a[3 * i + j] + b[3 * j + i]);
        }
  }
} // namespace Voussoir
