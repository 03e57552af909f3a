// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/solid/cell_elasticity.h>
#include <voussoir/solid/initial_strain.h>
#include <voussoir/solid/nodal_mean.h>
#include <voussoir/solid/solid_grid.h>
#include <voussoir/solid/solid_model.h>

#include <cmath>

namespace Voussoir
{
  using namespace dealii;

  namespace
  {
    /** Returns the weight of a Gauss point of QGauss<3>(2) in the trilinear extrapolation to a point of
     * the unit cell. */
    double extrapolated(const Point<3> &to, const Point<3> &gauss)
    {
      double weight = 1.;
      for (unsigned int d = 0; d < 3; ++d)
      {
        const double xi = (2. * to[d] - 1.) * std::sqrt(3.);
        weight *= .5 * (1. + (gauss[d] > .5 ? xi : -xi));
      }
      return weight;
    }
  } // namespace

  void CellElasticity::initial_strain(const std::vector<double> &strain, std::vector<double> &load,
                                      std::vector<std::array<double, 6>> &stress)
  {
    stress_values.reinit(cell);
    const unsigned int n = fe.n_dofs_per_cell();
    const double       bulk = 3. * lambda + 2. * mu; // D m = bulk m
    const auto         strain_at = [&](const Point<3> &p)
    {
      double sum = 0.;
      for (unsigned int i = 0; i < n; ++i)
        sum += strain[i] * fe.shape_value(i, p);
      return sum;
    };
    load.assign(3 * n, 0.);
    Vector<double> of_modes(9), modes_of_strain(9);
    for (const unsigned int q : values.quadrature_point_indices())
    {
      const double s = bulk * strain_at(values.get_quadrature().point(q)) * values.JxW(q);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int c = 0; c < 3; ++c)
          load[3 * i + c] += s * values.shape_grad(i, q)[c];
      for (unsigned int m = 0; modes && m < 3; ++m)
        for (unsigned int c = 0; c < 3; ++c)
          of_modes[3 * m + c] += s * mode_gradient(values, q, m)[c];
    }
    if (modes) // the modes follow the strain
    {
      mode_of_force.vmult(modes_of_strain, of_modes);
      for (unsigned int k = 0; k < 3 * n; ++k)
        for (unsigned int m = 0; m < 9; ++m)
          load[k] += mode_of_displacement(m, k) * of_modes[m];
    }
    stress.assign(n, {});
    for (unsigned int q = 0; q < 8; ++q)
    {
      const Point<3>       &point = stress_values.get_quadrature().point(q);
      SymmetricTensor<2, 3> sigma = -bulk * strain_at(point) * unit_symmetric_tensor<3>();
      for (unsigned int m = 0; modes && m < 3; ++m)
      {
        const Tensor<1, 3> g = mode_gradient(stress_values, q, m);
        Tensor<2, 3>       gradient;
        for (unsigned int c = 0; c < 3; ++c)
          gradient[c] = modes_of_strain[3 * m + c] * g;
        const SymmetricTensor<2, 3> eps = symmetrize(gradient);
        sigma += lambda * trace(eps) * unit_symmetric_tensor<3>() + 2. * mu * eps;
      }
      const std::array<double, 6> s = {
          {sigma[0][0], sigma[1][1], sigma[2][2], sigma[0][1], sigma[1][2], sigma[2][0]}};
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int k = 0; k < 6; ++k)
          stress[i][k] += extrapolated(fe.unit_support_point(i), point) * s[k];
    }
  }

  InitialStrain initial_strain(const SolidModel &model, const std::vector<Material> &materials,
                               const bool incompatible_modes, const std::vector<double> &strain,
                               const bool to_base)
  {
    InitialStrain                        result{Unknowns(3 * std::size_t(model.first_equation.back()), 0.),
                         std::vector<Stress>(model.n_nodes(), Stress{})};
    const NodalMean                      mean(model, materials, to_base);
    std::vector<types::global_dof_index> dofs(model.grid->fe.n_dofs_per_cell());
    std::vector<std::array<double, 6>>   sum(model.n_nodes()), of_base(model.n_nodes()), stress;
    std::vector<double>                  of_cell(dofs.size()), load;
    CellElasticity                       elasticity(model.grid->fe, incompatible_modes);
    auto                                 share = mean.shares.begin();
    for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      const Material &material = model.material_of(cell->active_cell_index(), materials);
      for (unsigned int i = 0; i < dofs.size(); ++i)
        of_cell[i] = strain[dofs[i]];
      elasticity.reinit(cell, material);
      elasticity.initial_strain(of_cell, load, stress);
      for (unsigned int i = 0; i < dofs.size(); ++i)
      {
        const unsigned int node = dofs[i], e = model.equation[node];
        for (unsigned int c = 0; e != rigid_ground && c < 3; ++c)
          result.load[3 * std::size_t(e) + c] += load[3 * i + c];
        for (unsigned int k = 0; material.young == mean.material[node].young && k < 6; ++k)
          sum[node][k] += stress[i][k];
      }
      for (; share != mean.shares.end() && share->cell == cell->active_cell_index(); ++share)
        for (unsigned int k = 0; k < 36; ++k)
          of_base[share->node][k / 6] += share->weight[k] * stress[share->local][k % 6];
    }
    for (unsigned int i = 0; i < model.n_nodes(); ++i)
      for (unsigned int k = 0; k < 6; ++k)
        result.stress[i][k] = static_cast<float>(sum[i][k] / mean.n_cells[i] + of_base[i][k]);
    return result;
  }
} // namespace Voussoir
