// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/tensor3.h>

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

  double determinant(const Matrix3 &a)
  {
    return a[0] * (a[4] * a[8] - a[5] * a[7]) - a[1] * (a[3] * a[8] - a[5] * a[6]) +
           a[2] * (a[3] * a[7] - a[4] * a[6]);
  }
} // namespace Voussoir
