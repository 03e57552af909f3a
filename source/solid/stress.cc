// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/lanes.h>
#include <voussoir/base/simd.h>
#include <voussoir/solid/cell_elasticity.h>
#include <voussoir/solid/nodal_mean.h>
#include <voussoir/solid/solid_grid.h>
#include <voussoir/solid/solid_model.h>
#include <voussoir/solid/stress.h>
#include <voussoir/solid/traction_condition.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  using namespace dealii;

  namespace
  {
    /** Returns cos(2/3 acos(s)) for 0 <= s <= 1: the polynomial through its values at Chebyshev points, with an error of
     * 2e-12. With s = sqrt((1 + r)/2) this is cos(acos(r)/3). */
    double cosine_of_third(const double s)
    {
      constexpr double c[] = {.50000000000184919,   .5773502685621289,     -.11111107550248116,
                              .053457555912007897,  -.032912299460351721,  .02280012350716136,
                              -.016750073852596324, .012328578895090456,   -.0084089123624231446,
                              .0048143851878839211, -.0020621250024546824, .00056717715754875386,
                              -7.3603044374673e-05};
      double           sum = c[12];
      for (unsigned int k = 12; k-- > 0;)
        sum = c[k] + s * sum;
      return sum;
    }
  } // namespace

  std::array<float, 2> principal_stresses(const Stress &s)
  {
    // Trigonometric solution of the characteristic equation of the deviator, with diagonal x y z.
    const double mean = (double(s[0]) + s[1] + s[2]) / 3., x = s[0] - mean, y = s[1] - mean, z = s[2] - mean,
                 xy = s[3], yz = s[4], zx = s[5];
    const double p = std::sqrt((x * x + y * y + z * z + 2. * (xy * xy + yz * yz + zx * zx)) / 6.);
    if (p <= 1e-30)
      return {{float(mean), float(mean)}};
    const double determinant = x * (y * z - yz * yz) - xy * (xy * z - yz * zx) + zx * (xy * yz - y * zx);
    const double r = std::clamp(determinant / (2. * p * p * p), -1., 1.);
    return {{float(mean + 2. * p * cosine_of_third(std::sqrt(.5 + .5 * r))),
             float(mean - 2. * p * cosine_of_third(std::sqrt(.5 - .5 * r)))}};
  }

  namespace
  {
    float product(const Stress &factor, const Stress &s)
    {
      float sum = 0.f;
      for (unsigned int c = 0; c < 6; ++c)
        sum += factor[c] * s[c];
      return sum;
    }
  } // namespace

  std::array<float, NodeOnFace::n_stresses> NodeOnFace::stresses(const Stress &s) const
  {
    return {{product(arch, s), product(cantilever, s), s[2]}};
  }

  StressRecovery::StressRecovery(const SolidModel &model, const std::vector<Material> &materials,
                                 const bool incompatible_modes, const std::vector<NodeFace> &faces,
                                 const bool to_base)
  {
    const NodalMean mean(model, materials, to_base);
    find_columns(model, mean);
    add_cells(model, materials, incompatible_modes, mean);
    condition(faces, mean);
  }

  void StressRecovery::find_columns(const SolidModel &model, const NodalMean &mean)
  {
    std::vector<std::vector<unsigned int>> columns(model.n_nodes());
    std::vector<types::global_dof_index>   dofs(model.grid->fe.n_dofs_per_cell());
    auto                                   share = mean.shares.begin();
    for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      const auto add = [&](const unsigned int node)
      {
        for (const auto j : dofs)
          if (model.equation[j] != rigid_ground)
            columns[node].push_back(model.equation[j]);
      };
      for (const auto i : dofs)
        add(i);
      for (; share != mean.shares.end() && share->cell == cell->active_cell_index(); ++share)
        add(share->node);
    }
    start.push_back(0);
    for (auto &row : columns)
    {
      std::sort(row.begin(), row.end());
      row.erase(std::unique(row.begin(), row.end()), row.end());
      column.insert(column.end(), row.begin(), row.end());
      start.push_back(column.size());
    }
    blocks.assign(column.size(), std::array<float, 18>{});
  }

  std::array<float, 18> &StressRecovery::block(const unsigned int node, const unsigned int free_node)
  {
    const auto begin = column.begin() + start[node], end = column.begin() + start[node + 1];
    return blocks[std::lower_bound(begin, end, free_node) - column.begin()];
  }

  /** Adds the mean over the cells around each node. */
  void StressRecovery::add_cells(const SolidModel &model, const std::vector<Material> &materials,
                                 const bool incompatible_modes, const NodalMean &mean)
  {
    std::vector<types::global_dof_index> dofs(model.grid->fe.n_dofs_per_cell());
    CellElasticity                       elasticity(model.grid->fe, incompatible_modes);
    std::vector<std::array<double, 18>>  cell_blocks;
    auto                                 share = mean.shares.begin();
    for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      const Material &of_cell = model.material_of(cell->active_cell_index(), materials);
      elasticity.reinit(cell, of_cell);
      elasticity.stress_operator(cell_blocks);
      for (unsigned int i = 0; i < dofs.size(); ++i)
        for (unsigned int j = 0; j < dofs.size(); ++j)
          if (model.equation[dofs[j]] != rigid_ground && of_cell.young == mean.material[dofs[i]].young)
          {
            auto &entry = block(dofs[i], model.equation[dofs[j]]);
            for (unsigned int k = 0; k < 18; ++k)
              entry[k] += static_cast<float>(cell_blocks[i * dofs.size() + j][k] / mean.n_cells[dofs[i]]);
          }
      for (; share != mean.shares.end() && share->cell == cell->active_cell_index(); ++share)
        for (unsigned int j = 0; j < dofs.size(); ++j)
          if (model.equation[dofs[j]] != rigid_ground)
          {
            auto       &entry = block(share->node, model.equation[dofs[j]]);
            const auto &of_cell_block = cell_blocks[share->local * dofs.size() + j];
            for (unsigned int k = 0; k < 18; ++k)
              for (unsigned int c = 0; c < 6; ++c)
                entry[k] += static_cast<float>(share->weight[6 * (k / 3) + c] * of_cell_block[3 * c + k % 3]);
          }
    }
  }

  /** Replaces the rows of nodes with known tractions by the result of TractionCondition. */
  void StressRecovery::condition(const std::vector<NodeFace> &faces, const NodalMean &mean)
  {
    face.assign(start.size(), 0);
    for (std::size_t f = 0; f < faces.size(); f = of_traction.size())
    {
      const unsigned int   node = faces[f].node;
      std::vector<Vector3> normals;
      for (std::size_t k = f; k < faces.size() && faces[k].node == node; ++k)
        normals.push_back(faces[k].normal);
      const TractionCondition known(mean.material[node].poisson, normals);
      for (std::size_t k = start[node]; k < start[node + 1]; ++k)
      {
        const std::array<float, 18> given = blocks[k];
        for (unsigned int c = 0; c < 6; ++c)
          for (unsigned int d = 0; d < 3; ++d)
          {
            double sum = 0.;
            for (unsigned int e = 0; e < 6; ++e)
              sum += known.of_stress[c][e] * given[3 * e + d];
            blocks[k][3 * c + d] = static_cast<float>(sum);
          }
      }
      for (const auto &block : known.of_traction)
      {
        of_traction.emplace_back();
        std::copy(block.begin(), block.end(), of_traction.back().begin());
      }
      face[node + 1] = of_traction.size();
    }
    for (std::size_t i = 1; i < face.size(); ++i)
      face[i] = std::max(face[i], face[i - 1]);
  }

  namespace
  {
    namespace StressKernels
    {
#define VOUSSOIR_KERNEL <solid/stress_kernel.h>
#include <voussoir/base/for_lanes.h>
#undef VOUSSOIR_KERNEL
    } // namespace StressKernels
  }   // namespace

  StressKernel stress_kernel()
  {
    using namespace StressKernels;
    return VOUSSOIR_FOR_LANES(stress_of_node);
  }

  StressView StressRecovery::view() const
  {
    StressView result;
    result.start = start.data();
    result.column = column.data();
    result.block = blocks.data();
    result.of_traction = of_traction.data();
    result.face = face.data();
    return result;
  }

  void StressRecovery::apply(const Unknowns &u, const std::vector<Vector3> &tractions,
                             std::vector<Stress> &stress) const
  {
    const unsigned int lanes = n_lanes();
    std::vector<float> of_u(lanes * u.size()), of_faces(3 * lanes * tractions.size());
    for (std::size_t k = 0; k < u.size(); ++k)
      of_u[lanes * k] = static_cast<float>(u[k]);
    for (std::size_t k = 0; k < 3 * tractions.size(); ++k)
      of_faces[lanes * k] = static_cast<float>(tractions[k / 3][k % 3]);
    StressView view = this->view();
    view.u = of_u.data();
    view.traction = tractions.empty() ? nullptr : of_faces.data();
    stress.resize(start.size() - 1);
    const StressKernel kernel = stress_kernel();
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < stress.size(); ++i)
    {
      float all[6 * most_lanes];
      kernel(view, i, all);
      for (unsigned int c = 0; c < 6; ++c)
        stress[i][c] = all[lanes * c];
    }
  }
} // namespace Voussoir
