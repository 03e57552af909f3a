// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_solid_grid_h
#define voussoir_solid_grid_h

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/tria.h>

#include <voussoir/base/tensor3.h>

namespace Voussoir
{
  /** Cells and faces of a SolidModel in deal.II. Only sources that loop over cells include this header. */
  struct SolidGrid
  {
    explicit SolidGrid(const unsigned int degree) : fe(degree), dof_handler(triangulation) {}

    dealii::Triangulation<3> triangulation; ///< material id: block; boundary id: surface
    dealii::FE_Q<3>          fe;
    dealii::DoFHandler<3>    dof_handler; ///< each node is one scalar degree of freedom
  };

  inline dealii::Point<3> to_point(const Vector3 &x)
  {
    return {x[0], x[1], x[2]};
  }

  inline Vector3 to_vector(const dealii::Point<3> &p)
  {
    return {{p[0], p[1], p[2]}};
  }
} // namespace Voussoir

#endif
