// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/lac/tridiagonal_matrix.h>

#include <voussoir/base/tridiagonal.h>

namespace Voussoir
{
  double Tridiagonal::largest_eigenvalue() const
  {
    const std::size_t                 n = diagonal.size();
    dealii::TridiagonalMatrix<double> T(n, true);
    for (std::size_t i = 0; i < n; ++i)
    {
      T(i, i) = diagonal[i];
      if (i + 1 < n)
        T(i, i + 1) = beside[i];
    }
    T.compute_eigenvalues();
    return T.eigenvalue(n - 1);
  }
} // namespace Voussoir
