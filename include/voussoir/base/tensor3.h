// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_tensor3_h
#define voussoir_tensor3_h

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace Voussoir
{
  using Vector3 = std::array<double, 3>;
  using Matrix3 = std::array<double, 9>; ///< row by row
  using Unknowns = std::vector<double>;  ///< three components per node, node after node

  inline Vector3 operator*(const Matrix3 &a, const Vector3 &x)
  {
    return {{a[0] * x[0] + a[1] * x[1] + a[2] * x[2], a[3] * x[0] + a[4] * x[1] + a[5] * x[2],
             a[6] * x[0] + a[7] * x[1] + a[8] * x[2]}};
  }

  inline Matrix3 times(const Matrix3 &a, const Matrix3 &b)
  {
    Matrix3 c;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        c[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
    return c;
  }

  inline Matrix3 transpose(const Matrix3 &a)
  {
    return {{a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]}};
  }

  /** Returns a + factor b. */
  inline Matrix3 sum(const Matrix3 &a, const double factor, const Matrix3 &b)
  {
    Matrix3 c;
    for (unsigned int i = 0; i < 9; ++i)
      c[i] = a[i] + factor * b[i];
    return c;
  }

  inline Matrix3 inverse(const Matrix3 &a)
  {
    const double c0 = a[4] * a[8] - a[5] * a[7], c1 = a[5] * a[6] - a[3] * a[8],
                 c2 = a[3] * a[7] - a[4] * a[6];
    const double d = 1. / (a[0] * c0 + a[1] * c1 + a[2] * c2);
    return {{c0 * d, (a[2] * a[7] - a[1] * a[8]) * d, (a[1] * a[5] - a[2] * a[4]) * d, c1 * d,
             (a[0] * a[8] - a[2] * a[6]) * d, (a[2] * a[3] - a[0] * a[5]) * d, c2 * d,
             (a[1] * a[6] - a[0] * a[7]) * d, (a[0] * a[4] - a[1] * a[3]) * d}};
  }

  inline double determinant(const Matrix3 &a)
  {
    return a[0] * (a[4] * a[8] - a[5] * a[7]) - a[1] * (a[3] * a[8] - a[5] * a[6]) +
           a[2] * (a[3] * a[7] - a[4] * a[6]);
  }

  inline double dot(const Vector3 &a, const Vector3 &b)
  {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  inline double norm(const Vector3 &x)
  {
    return std::sqrt(dot(x, x));
  }

  inline double distance_between(const Vector3 &a, const Vector3 &b)
  {
    return norm({{b[0] - a[0], b[1] - a[1], b[2] - a[2]}});
  }

  /** Returns the length of the vector (x, y). */
  inline double length(const double x, const double y)
  {
    return std::sqrt(x * x + y * y);
  }

  inline Vector3 operator-(const Vector3 &a, const Vector3 &b)
  {
    return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
  }

  inline Vector3 cross(const Vector3 &a, const Vector3 &b)
  {
    return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
  }

  inline Vector3 scaled(const double factor, const Vector3 &x)
  {
    return {{factor * x[0], factor * x[1], factor * x[2]}};
  }

  /** Adds @p x to @p y. */
  inline void add(Vector3 &y, const Vector3 &x)
  {
    for (unsigned int c = 0; c < 3; ++c)
      y[c] += x[c];
  }

  /** Returns a^T x. */
  inline Vector3 transpose_times(const Matrix3 &a, const Vector3 &x)
  {
    return {{a[0] * x[0] + a[3] * x[1] + a[6] * x[2], a[1] * x[0] + a[4] * x[1] + a[7] * x[2],
             a[2] * x[0] + a[5] * x[1] + a[8] * x[2]}};
  }

  /** Returns the three components of node or pair @p i. */
  inline Vector3 get(const Unknowns &x, const std::size_t i)
  {
    return {{x[3 * i], x[3 * i + 1], x[3 * i + 2]}};
  }

  /** Sets the three components of node or pair @p i. */
  inline void set(Unknowns &x, const std::size_t i, const Vector3 &value)
  {
    std::copy(value.begin(), value.end(), x.begin() + 3 * i);
  }
} // namespace Voussoir

#endif
