// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/quadrature.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_values.h>

#include <voussoir/solid/node_faces.h>
#include <voussoir/solid/solid_grid.h>
#include <voussoir/solid/solid_model.h>

#include <cmath>

namespace Voussoir
{
  using namespace dealii;

  namespace
  {
    /** Adds the area vector of an element face to the matching face of the node, or adds a new face. */
    void add_face(std::vector<NodeFace> &faces, const unsigned int node, const int surface,
                  const Vector3 &area)
    {
      for (NodeFace &face : faces)
        if (face.surface == surface &&
            dot(face.normal, area) > std::sqrt(.75) * norm(face.normal) * norm(area))
          return add(face.normal, area);
      faces.push_back({node, surface, area});
    }

    /** Returns the faces of the surface "base", or those of all other surfaces. */
    std::vector<NodeFace> find_faces(const SolidModel &model, const bool of_base)
    {
      std::vector<Point<2>> places; // nodes of a face
      for (unsigned int i = 0; i < model.grid->fe.n_dofs_per_face(); ++i)
        places.push_back(model.grid->fe.unit_face_support_point(i));
      FEFaceValues<3> values(model.grid->fe, Quadrature<2>(places), update_values | update_boundary_forms);
      std::vector<std::vector<NodeFace>>   at_node(model.n_nodes());
      std::vector<types::global_dof_index> dofs(model.grid->fe.n_dofs_per_cell());
      for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary() && (cell->face(f)->boundary_id() == PhysicalId::base) == of_base)
          {
            values.reinit(cell, f);
            cell->get_dof_indices(dofs);
            for (unsigned int i = 0; i < dofs.size(); ++i)
              for (const unsigned int q : values.quadrature_point_indices())
                if (values.shape_value(i, q) > .5) // node of this point
                {
                  const Tensor<1, 3> &area = values.boundary_form(q);
                  add_face(at_node[dofs[i]], dofs[i], cell->face(f)->boundary_id(),
                           {{area[0], area[1], area[2]}});
                }
          }
      std::vector<NodeFace> faces;
      for (const auto &of_node : at_node)
        for (const NodeFace &face : of_node)
          if (model.on_surface(face.node, PhysicalId::base) == of_base)
          {
            faces.push_back(face);
            for (double &x : faces.back().normal)
              x /= norm(face.normal);
            if (model.plane_strain && std::abs(faces.back().normal[1]) > .5)
              faces.pop_back();
          }
      return faces;
    }
  } // namespace

  std::vector<NodeFace> faces_at_nodes(const SolidModel &model)
  {
    return find_faces(model, false);
  }

  std::vector<NodeFace> faces_of_base(const SolidModel &model)
  {
    return find_faces(model, true);
  }
} // namespace Voussoir
