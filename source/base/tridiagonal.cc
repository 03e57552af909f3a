// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/lac/tridiagonal_matrix.h>

#include <voussoir/base/tridiagonal.h>

#include <cmath>

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
        T(i, i + 1) = off_diagonal[i];
    }
    T.compute_eigenvalues();
    return T.eigenvalue(n - 1);
  }

  double Tridiagonal::residual(const double eigenvalue) const
  {
    const std::size_t n = diagonal.size();
    // Eigenvector from its last component to the first. In this direction the components grow.
    double after = 0., now = 1., square = 1.;
    for (std::size_t i = n - 1; i > 0; --i)
    {
      const double before = ((eigenvalue - diagonal[i]) * now - (i + 1 < n ? off_diagonal[i] * after : 0.)) /
                            off_diagonal[i - 1];
      after = now;
      now = before;
      square += now * now;
    }
    return off_diagonal[n - 1] / std::sqrt(square);
  }
} // namespace Voussoir
