// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/solid/nodal_mean.h>
#include <voussoir/solid/node_faces.h>
#include <voussoir/solid/solid_grid.h>
#include <voussoir/solid/solid_model.h>
#include <voussoir/solid/traction_condition.h>

#include <algorithm>

namespace Voussoir
{
  using namespace dealii;

  namespace
  {
    using Cell = DoFHandler<3>::active_cell_iterator;
    using Dofs = std::vector<types::global_dof_index>;

    /** Returns the change of the nodal stress (6 x 6) due to a stress that adds its traction on one of the
     * planes of the node. That plane is the one whose normal is closest to @p outward. */
    std::array<double, 36> by_traction(const double poisson, const std::vector<Vector3> &normals,
                                       const Tensor<1, 3> &outward)
    {
      constexpr unsigned int component[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
      const auto             through = [&](const Vector3 &n)
      { return n[0] * outward[0] + n[1] * outward[1] + n[2] * outward[2]; };
      const std::size_t plane =
          std::max_element(normals.begin(), normals.end(),
                           [&](const Vector3 &a, const Vector3 &b) { return through(a) < through(b); }) -
          normals.begin();
      const TractionCondition known(poisson, normals);
      std::array<double, 36>  result{};
      for (unsigned int c = 0; c < 6; ++c)
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int d = 0; d < 3; ++d)
            result[6 * c + component[i][d]] += known.of_traction[plane][3 * c + i] * normals[plane][d];
      return result;
    }

    std::array<double, 36> scaled(const double factor, std::array<double, 36> a)
    {
      for (double &x : a)
        x *= factor;
      return a;
    }
  } // namespace

  NodalMean::NodalMean(const SolidModel &model, const std::vector<Material> &materials, const bool to_base)
      : material(model.n_nodes(), Material{0.}), n_cells(model.n_nodes(), 0)
  {
    Dofs dofs(model.grid->fe.n_dofs_per_cell());
    for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      const Material &of_cell = model.material_of(cell->active_cell_index(), materials);
      for (const auto i : dofs)
      {
        if (of_cell.young > material[i].young)
        {
          material[i] = of_cell;
          n_cells[i] = 0;
        }
        n_cells[i] += of_cell.young == material[i].young;
      }
    }
    if (to_base && model.degree == 1)
      add_base(model, materials);
  }

  void NodalMean::add_base(const SolidModel &model, const std::vector<Material> &materials)
  {
    std::vector<std::vector<Vector3>> normals(model.n_nodes());
    for (const NodeFace &face : faces_of_base(model))
      normals[face.node].push_back(face.normal);
    Dofs dofs(8), above(8);
    for (const Cell &cell : model.grid->dof_handler.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
      {
        const unsigned int d = f / 2, opposite = f ^ 1u; // direction of the element height
        if (!cell->face(f)->at_boundary() || cell->face(f)->boundary_id() != PhysicalId::base ||
            cell->at_boundary(opposite))
          continue;
        const Cell         next = cell->neighbor(opposite);
        const unsigned int next_d = cell->neighbor_of_neighbor(opposite) / 2;
        cell->get_dof_indices(dofs);
        next->get_dof_indices(above);
        for (unsigned int i = 0; i < 8; ++i)
          if (const unsigned int node = dofs[i];
              (i >> d & 1u) == f % 2 &&
              model.material_of(cell->active_cell_index(), materials).young == material[node].young)
          {
            const unsigned int j = i ^ (1u << d),
                               low = std::find(above.begin(), above.end(), dofs[j]) - above.begin(),
                               high = low ^ (1u << next_d);
            const Tensor<1, 3> edge = to_point(model.points[node]) - to_point(model.points[dofs[j]]);
            const double       h_1 = edge.norm(),
                         h_2 = distance_between(model.points[dofs[j]], model.points[above[high]]),
                         w = h_1 / (h_1 + h_2);
            const auto P =
                scaled(1. / n_cells[node], by_traction(material[node].poisson, normals[node], edge));
            shares.push_back({cell->active_cell_index(), i, node, scaled(.5 * (w - 1.), P)});
            shares.push_back({cell->active_cell_index(), j, node, scaled(.5 * (w + 1.), P)});
            shares.push_back({next->active_cell_index(), low, node, scaled(-.5 * w, P)});
            shares.push_back({next->active_cell_index(), high, node, scaled(-.5 * w, P)});
          }
      }
    std::stable_sort(shares.begin(), shares.end(),
                     [](const Share &a, const Share &b) { return a.cell < b.cell; });
  }
} // namespace Voussoir
