// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>

#include <voussoir/mesh/mesh.h>
#include <voussoir/solid/cell_elasticity.h>

#include <cmath>

namespace Voussoir
{
  using namespace dealii;

  CellElasticity::CellElasticity(const dealii::FiniteElement<3> &fe, const bool incompatible_modes)
      : CellElasticity(fe, incompatible_modes, QGauss<3>(fe.degree + 1))
  {
  }

  CellElasticity::CellElasticity(const dealii::FiniteElement<3> &fe, const bool incompatible_modes,
                                 const dealii::Quadrature<3> &of_stiffness)
      : fe(fe), modes(incompatible_modes && fe.degree == 1),
        values(fe, of_stiffness,
               update_gradients | update_JxW_values | (modes ? update_jacobians : update_default)),
        mass_values(fe, QGauss<3>(fe.degree + 1), update_values | update_JxW_values),
        stress_values(fe, QGauss<3>(2), update_gradients | update_inverse_jacobians | update_jacobians),
        centre(fe, QMidpoint<3>(), update_inverse_jacobians | update_jacobians)
  {
  }

  Tensor<1, 3> CellElasticity::mode_gradient(const FEValues<3> &at, const unsigned int q,
                                             const unsigned int m) const
  {
    const double x = at.get_quadrature().point(q)[m]; // xi = 2x - 1, d(1 - xi^2)/dx = -4 (2x - 1)
    const double scale = centre.jacobian(0).determinant() / at.jacobian(q).determinant();
    Tensor<1, 3> g;
    for (unsigned int d = 0; d < 3; ++d)
      g[d] = -4. * (2. * x - 1.) * centre.inverse_jacobian(0)[m][d] * scale;
    return g;
  }

  void CellElasticity::reinit(const DoFHandler<3>::active_cell_iterator &this_cell, const Material &material)
  {
    cell = this_cell;
    const double e = material.young, nu = material.poisson;
    lambda = e * nu / ((1 + nu) * (1 - 2 * nu));
    mu = e / (2 * (1 + nu));
    values.reinit(cell);
    mass_values.reinit(cell);
    if (modes)
      centre.reinit(cell);
    const unsigned int n = fe.n_dofs_per_cell(), n_all = n + (modes ? 3 : 0);
    stiffness.assign(n_all * n_all, Matrix3{});
    mass.assign(n, 0.);
    for (const unsigned int q : mass_values.quadrature_point_indices())
      for (unsigned int i = 0; i < n; ++i)
        mass[i] += material.density * mass_values.shape_value(i, q) * mass_values.JxW(q);
    std::vector<Tensor<1, 3>> gradient(n_all);
    for (const unsigned int q : values.quadrature_point_indices())
    {
      const double JxW = values.JxW(q);
      for (unsigned int i = 0; i < n; ++i)
        gradient[i] = values.shape_grad(i, q);
      for (unsigned int m = n; m < n_all; ++m)
        gradient[m] = mode_gradient(values, q, m - n);
      for (unsigned int i = 0; i < n_all; ++i)
        for (unsigned int j = 0; j <= i; ++j)
        {
          const Tensor<1, 3> &g = gradient[i], &h = gradient[j];
          if (g == Tensor<1, 3>() || h == Tensor<1, 3>()) // most products vanish with nodal quadrature
            continue;
          const double gh = mu * (g * h);
          for (unsigned int a = 0; a < 3; ++a)
            for (unsigned int b = 0; b < 3; ++b)
              stiffness[i * n_all + j][3 * a + b] +=
                  JxW * (lambda * g[a] * h[b] + mu * g[b] * h[a] + (a == b ? gh : 0.));
        }
    }
    for (unsigned int i = 0; i < n_all; ++i)
      for (unsigned int j = i + 1; j < n_all; ++j)
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; b < 3; ++b)
            stiffness[i * n_all + j][3 * a + b] = stiffness[j * n_all + i][3 * b + a];
    if (modes)
      condense();
  }

  void CellElasticity::condense()
  {
    const unsigned int  n = fe.n_dofs_per_cell(), n_all = n + 3;
    FullMatrix<double> &K_aa = mode_of_force, K_au(9, 3 * n);
    K_aa.reinit(9, 9);
    mode_of_displacement.reinit(9, 3 * n);
    for (unsigned int i = 0; i < 9; ++i)
    {
      for (unsigned int j = 0; j < 9; ++j)
        K_aa(i, j) = stiffness[(n + i / 3) * n_all + n + j / 3][3 * (i % 3) + j % 3];
      for (unsigned int j = 0; j < 3 * n; ++j)
        K_au(i, j) = stiffness[(n + i / 3) * n_all + j / 3][3 * (i % 3) + j % 3];
    }
    K_aa.gauss_jordan();
    if (is_footing(static_cast<int>(cell->material_id())))
      K_aa = 0.; // thin: with modes its nodes would shear alternately
    K_aa.mmult(mode_of_displacement, K_au);
    mode_of_displacement *= -1.;
    std::vector<Matrix3> condensed(n * n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; b < 3; ++b)
          {
            double &x = condensed[i * n + j][3 * a + b] = stiffness[i * n_all + j][3 * a + b];
            for (unsigned int k = 0; k < 9; ++k)
              x += K_au(k, 3 * i + a) * mode_of_displacement(k, 3 * j + b);
          }
    stiffness.swap(condensed);
  }

  void CellElasticity::stress_operator(std::vector<std::array<double, 18>> &blocks)
  {
    stress_values.reinit(cell);
    const unsigned int n = fe.n_dofs_per_cell();
    // Adds the stress of a displacement gradient g of the displacement component c.
    const auto stress = [&](const Tensor<1, 3> &g, const unsigned int c, std::array<double, 18> &s)
    {
      for (unsigned int k = 0; k < 3; ++k)
        s[3 * k + c] += lambda * g[c];
      s[3 * c + c] += 2. * mu * g[c];
      constexpr unsigned int first[3] = {0, 1, 2}, second[3] = {1, 2, 0}; // xy, yz, zx
      for (unsigned int k = 0; k < 3; ++k)
        if (c == first[k])
          s[3 * (3 + k) + c] += mu * g[second[k]];
        else if (c == second[k])
          s[3 * (3 + k) + c] += mu * g[first[k]];
    };
    std::vector<std::array<double, 18>> at_point(8 * n, std::array<double, 18>{});
    for (unsigned int q = 0; q < 8; ++q)
    {
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int c = 0; c < 3; ++c)
          stress(stress_values.shape_grad(j, q), c, at_point[q * n + j]);
      if (modes)
        for (unsigned int m = 0; m < 3; ++m)
        {
          std::array<double, 18> s{};
          for (unsigned int c = 0; c < 3; ++c)
            stress(mode_gradient(stress_values, q, m), c, s);
          for (unsigned int j = 0; j < n; ++j)
            for (unsigned int k = 0; k < 6; ++k)
              for (unsigned int c = 0; c < 3; ++c)
                for (unsigned int d = 0; d < 3; ++d)
                  at_point[q * n + j][3 * k + c] += s[3 * k + d] * mode_of_displacement(3 * m + d, 3 * j + c);
        }
    }
    // Trilinear extrapolation from the Gauss points.
    blocks.assign(std::size_t(n) * n, std::array<double, 18>{});
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int q = 0; q < 8; ++q)
      {
        double weight = 1.;
        for (unsigned int d = 0; d < 3; ++d)
        {
          const double xi = (2. * fe.unit_support_point(i)[d] - 1.) * std::sqrt(3.);
          weight *= .5 * (1. + (stress_values.get_quadrature().point(q)[d] > .5 ? xi : -xi));
        }
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int k = 0; k < 18; ++k)
            blocks[i * n + j][k] += weight * at_point[q * n + j][k];
      }
  }
} // namespace Voussoir
