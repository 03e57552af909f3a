// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <voussoir/solid/traction_condition.h>

namespace Voussoir
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int component[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}; // stress component
    /** Smallest relative singular value; planes within about 10 degrees count as one. */
    constexpr double smallest = .02;

    /** Returns C A^T, with C for a shear modulus of 1/2. */
    FullMatrix<double> stiff_transpose(const FullMatrix<double> &A, const double poisson)
    {
      FullMatrix<double> result(6, A.m());
      for (unsigned int i = 0; i < A.m(); ++i)
      {
        const double trace = A(i, 0) + A(i, 1) + A(i, 2);
        for (unsigned int c = 0; c < 6; ++c)
          result(c, i) = c < 3 ? A(i, c) + poisson / (1. - 2. * poisson) * trace : .5 * A(i, c);
      }
      return result;
    }
  } // namespace

  TractionCondition::TractionCondition(const double poisson, const std::vector<Vector3> &normals)
      : of_traction(normals.size())
  {
    const unsigned int n = 3 * normals.size();
    FullMatrix<double> A(n, 6);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int d = 0; d < 3; ++d)
        A(i, component[i % 3][d]) = normals[i / 3][d];
    const FullMatrix<double> CAt = stiff_transpose(A, poisson);
    FullMatrix<double>       ACAt(n, n), inverse(n, n), gain(6, n), of_given(6, 6);
    A.mmult(ACAt, CAt);
    LAPACKFullMatrix<double> lapack(n, n);
    lapack = ACAt;
    lapack.compute_inverse_svd(smallest);
    for (unsigned int i = 0; i < n; ++i)
    {
      Vector<double> unit(n), column(n);
      unit[i] = 1.;
      lapack.vmult(column, unit);
      for (unsigned int k = 0; k < n; ++k)
        inverse(k, i) = column[k];
    }
    CAt.mmult(gain, inverse);
    gain.mmult(of_given, A);
    for (unsigned int c = 0; c < 6; ++c)
    {
      for (unsigned int d = 0; d < 6; ++d)
        of_stress[c][d] = (c == d) - of_given(c, d);
      for (unsigned int i = 0; i < n; ++i)
        of_traction[i / 3][3 * c + i % 3] = gain(c, i);
    }
  }
} // namespace Voussoir
