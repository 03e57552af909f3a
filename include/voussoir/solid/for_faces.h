// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_for_faces_h
#define voussoir_for_faces_h

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <voussoir/solid/solid_grid.h>
#include <voussoir/solid/solid_model.h>

namespace Voussoir
{
  /** Calls f(values, dofs) for each element face of a surface.
   * @param model mesh of the bodies
   * @param surface boundary id
   * @param n_points number of Gauss points in each direction of a face
   * @param f receives the FEFaceValues of the face and the nodes of its cell */
  template <class Function>
  void for_faces(const SolidModel &model, const int surface, const unsigned int n_points, const Function &f)
  {
    using namespace dealii;
    FEFaceValues<3>                      values(model.grid->fe, QGauss<2>(n_points),
                                                update_values | update_normal_vectors | update_JxW_values |
                                                    update_quadrature_points);
    std::vector<types::global_dof_index> dofs(model.grid->fe.n_dofs_per_cell());
    for (const auto &cell : model.grid->dof_handler.active_cell_iterators())
      for (const unsigned int face : cell->face_indices())
        if (cell->face(face)->at_boundary() && model.is_on(cell->face(face)->boundary_id(), surface))
        {
          values.reinit(cell, face);
          cell->get_dof_indices(dofs);
          f(values, dofs);
        }
  }
} // namespace Voussoir

#endif
