// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/solid/face_quads.h>
#include <voussoir/solid/solid_grid.h>
#include <voussoir/solid/solid_model.h>

namespace Voussoir
{
  using namespace dealii;

  std::vector<FaceQuad> face_quads(const SolidModel &model, const int surface)
  {
    const unsigned int                   degree = model.degree, per_side = degree + 1;
    std::vector<FaceQuad>                quads;
    std::vector<types::global_dof_index> dofs(model.grid->fe.n_dofs_per_cell());
    std::vector<unsigned int>            lattice(per_side * per_side);
    for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary() && static_cast<int>(cell->face(f)->boundary_id()) == surface)
        {
          cell->get_dof_indices(dofs);
          // Nodes of the face by their two tangential reference coordinates.
          const unsigned int normal = f / 2, t0 = (normal + 1) % 3, t1 = (normal + 2) % 3;
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (model.grid->fe.has_support_on_face(i, f))
            {
              const Point<3> &x = model.grid->fe.unit_support_point(i);
              lattice[static_cast<unsigned int>(x[t1] * degree + .5) * per_side +
                      static_cast<unsigned int>(x[t0] * degree + .5)] = dofs[i];
            }
          for (unsigned int j = 0; j < degree; ++j)
            for (unsigned int i = 0; i < degree; ++i)
            {
              const unsigned int *low = &lattice[j * per_side + i], *high = low + per_side;
              quads.push_back({{{low[0], low[1], high[1], high[0]}}, cell->material_id(), f % 2 == 0});
            }
        }
    return quads;
  }

  std::vector<FaceQuad> quads_of_joint(const SolidModel &model, const unsigned int joint)
  {
    const int side_2 = PhysicalId::joint_side_2 + 1 + static_cast<int>(joint);
    return face_quads(model,
                      model.base_joints.count(side_2) > 0 ? side_2 : PhysicalId::joint_side_1 + 1 + joint);
  }

  double area(const SolidModel &model, const FaceQuad &quad)
  {
    const auto &p = model.points;
    return .5 * norm(cross(p[quad.nodes[2]] - p[quad.nodes[0]], p[quad.nodes[3]] - p[quad.nodes[1]]));
  }
} // namespace Voussoir
