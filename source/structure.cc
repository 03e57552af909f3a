#include <voussoir/structure.h>

#include <algorithm>
#include <cassert>

namespace Voussoir
{
  Matrix3 inverse(const Matrix3 &a)
  {
    const double c0 = a[4] * a[8] - a[5] * a[7], c1 = a[5] * a[6] - a[3] * a[8],
                 c2 = a[3] * a[7] - a[4] * a[6];
    const double d = 1. / (a[0] * c0 + a[1] * c1 + a[2] * c2);
    return {{c0 * d, (a[2] * a[7] - a[1] * a[8]) * d, (a[1] * a[5] - a[2] * a[4]) * d, c1 * d,
             (a[0] * a[8] - a[2] * a[6]) * d, (a[2] * a[3] - a[0] * a[5]) * d, c2 * d,
             (a[1] * a[6] - a[0] * a[7]) * d, (a[0] * a[4] - a[1] * a[3]) * d}};
  }

  Vector3 operator*(const Matrix3 &a, const Vector3 &x)
  {
    return {{a[0] * x[0] + a[1] * x[1] + a[2] * x[2], a[3] * x[0] + a[4] * x[1] + a[5] * x[2],
             a[6] * x[0] + a[7] * x[1] + a[8] * x[2]}};
  }

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
        if (column[k] >= row)
        {
          const auto begin = column.begin() + start[column[k]], end = column.begin() + start[column[k] + 1];
          Matrix3   &a = value[k], &b = value[std::lower_bound(begin, end, row) - column.begin()];
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              a[3 * i + j] = b[3 * j + i] = .5 * (a[3 * i + j] + b[3 * j + i]);
        }
  }

  void Structure::collect_interfaces()
  {
    std::vector<bool> in_pair(n_nodes(), false);
    for (const Pair &pair : pairs)
      for (const unsigned int node : {pair.node_1, pair.node_2})
        if (node != rigid_ground)
          in_pair[node] = true;
    for (Body &body : bodies)
    {
      body.interface.clear();
      for (unsigned int i = 0; i < body.n_nodes(); ++i)
        if (in_pair[body.first_node + i])
          body.interface.push_back(i);
    }
  }

  void Structure::multiply_stiffness(const Unknowns &u, Unknowns &Ku) const
  {
    Ku.resize(u.size());
    for (const Body &body : bodies)
      body.stiffness.multiply(u.data() + 3 * std::size_t(body.first_node),
                              Ku.data() + 3 * std::size_t(body.first_node));
  }

  Vector3 Structure::jump(const Pair &pair, const Unknowns &u) const
  {
    Vector3 d = {{0., 0., 0.}};
    for (unsigned int c = 0; c < 3; ++c)
      d[c] = (pair.node_2 == rigid_ground ? 0. : u[3 * pair.node_2 + c]) -
             (pair.node_1 == rigid_ground ? 0. : u[3 * pair.node_1 + c]);
    Vector3 result;
    for (unsigned int i = 0; i < 3; ++i)
      result[i] = pair.frame[i][0] * d[0] + pair.frame[i][1] * d[1] + pair.frame[i][2] * d[2];
    return result;
  }

  void Structure::add_pair_force(const Pair &pair, const Vector3 &f, Unknowns &u) const
  {
    for (unsigned int c = 0; c < 3; ++c)
    {
      const double x = pair.frame[0][c] * f[0] + pair.frame[1][c] * f[1] + pair.frame[2][c] * f[2];
      if (pair.node_2 != rigid_ground)
        u[3 * pair.node_2 + c] += x;
      if (pair.node_1 != rigid_ground)
        u[3 * pair.node_1 + c] -= x;
    }
  }
} // namespace Voussoir
