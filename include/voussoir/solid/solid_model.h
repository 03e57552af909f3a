// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_solid_model_h
#define voussoir_solid_model_h

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/tria.h>

#include <voussoir/mesh/mesh.h>
#include <voussoir/solid/material.h>
#include <voussoir/solid/structure.h>

#include <set>

namespace Voussoir
{
  /** The finite element mesh of the bodies: deal.II's triangulation of an opened mesh, its nodes (support
   * points of FE_Q(degree), Gauss-Lobatto), and which of them are free.
   *
   *  A node is a scalar degree of freedom of deal.II's; the three displacement components of free node i are
   * the unknowns 3 equation[i] + c. Free nodes are numbered body after body. */
  class SolidModel
  {
  public:
    /** @p mesh: opened, see open_joints(). Nodes on the surface "base" are fixed. */
    SolidModel(const HexMesh &mesh, unsigned int degree);

    /** Number the nodes of the base, too: the dam stands on rock. */
    void free_base();

    /** Number the free nodes anew; nodes with the same @p master (a node of the same body) move as one. */
    void number_equations(const std::vector<bool> &fixed, const std::vector<unsigned int> &master);

    bool         base_is_fixed = true;
    unsigned int n_nodes() const { return static_cast<unsigned int>(points.size()); }
    unsigned int n_bodies() const { return static_cast<unsigned int>(body_numbers.size()); }
    bool         on_surface(const unsigned int node, const int surface) const
    {
      return surfaces[node].count(surface) > 0;
    }

    /** That of the cell among @p materials: one for each zone of the mesh (HexMesh::zones), or a single one
     * for all. */
    const Material &material_of(const dealii::DoFHandler<3>::active_cell_iterator &cell,
                                const std::vector<Material>                       &materials) const;

    dealii::Triangulation<3>      triangulation; ///< material ids are monolith numbers, boundary ids surfaces
    dealii::FE_Q<3>               fe;
    dealii::DoFHandler<3>         dof_handler;
    std::vector<dealii::Point<3>> points;         ///< of the nodes [m]
    std::vector<unsigned int>     body;           ///< of each node: index into body_numbers
    std::vector<int>              body_numbers;   ///< monolith numbers, ascending
    std::size_t                   n_zones;        ///< of the mesh, also those without cells here
    std::vector<unsigned int>     zone;           ///< of each active cell: index into HexMesh::zones
    std::vector<std::set<int>>    surfaces;       ///< of each node
    std::vector<unsigned int>     equation;       ///< of each node; rigid_ground where fixed
    std::vector<unsigned int>     first_equation; ///< of each body, and the number of free nodes at the end

  private:
    void find_nodes();
  };

  /** Bodies with stiffness and lumped mass (row sums). Degree 1: eight-node elements with incompatible modes
   * (Wilson; Taylor, Beresford and Wilson 1976: constant Jacobian in the modes, so the patch test holds), or
   * plain trilinear ones when @p incompatible_modes is false. Degree 2: 27-node elements.
   *  @p materials: one per zone of the mesh, or a single one for all. */
  Structure assemble_structure(const SolidModel &model, const std::vector<Material> &materials,
                               bool incompatible_modes);
} // namespace Voussoir

#endif
