// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_solid_model_h
#define voussoir_solid_model_h

#include <voussoir/mesh/mesh.h>
#include <voussoir/solid/material.h>
#include <voussoir/solid/structure.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string>

namespace Voussoir
{
  struct SolidGrid;

  /** Finite element mesh of the bodies: the deal.II triangulation of an opened mesh, its nodes, and the
   * numbering of the free nodes. The nodes are the support points of FE_Q(degree) (Gauss-Lobatto).
   *
   * Each node is one scalar degree of freedom in deal.II. The displacement components of a free node i are
   * the unknowns 3 equation[i] + c. Free nodes are numbered body after body. */
  class SolidModel
  {
  public:
    /** Creates the triangulation and fixes the nodes on the surface "base".
     * @param mesh opened mesh, see open_joints()
     * @param degree polynomial degree, 1 or 2 */
    SolidModel(const HexMesh &mesh, unsigned int degree);
    SolidModel(SolidModel &&) noexcept;
    ~SolidModel();

    /** Includes the base nodes in the free nodes, for a dam on deformable rock. */
    void free_base();

    /** Includes the nodes of base joints in the free nodes.
     * @param sides sides of these joints: boundary ids. Nodes of other base faces remain fixed. */
    void free_base_joints(const std::set<int> &sides);

    /** Numbers the free nodes again. A node moves as its #master. @p fixed: whether each node is fixed; if one of the
     * nodes that move together is fixed, all are. */
    void number_equations(const std::vector<bool> &fixed);

    /** Makes pairs of nodes move together, and joins their bodies. Numbers the free nodes again.
     * @param pairs pairs of nodes
     * @param all_bodies true: joins all bodies */
    void merge(const std::vector<std::pair<unsigned int, unsigned int>> &pairs, bool all_bodies);

    bool         base_is_fixed = true;
    bool         plane_strain = false; ///< assemble_structure() decouples y: Structure::decouple_y()
    unsigned int n_nodes() const { return static_cast<unsigned int>(points.size()); }
    unsigned int n_bodies() const { return static_cast<unsigned int>(body_numbers.size()); }
    /** @p surface: the base (PhysicalId::base) includes the base joints. */
    bool on_surface(const unsigned int node, const int surface) const
    {
      return surfaces[node].count(surface) > 0;
    }

    /** Returns true if a node of the dam is on the base, or on a footing. */
    bool is_at_base(const unsigned int node) const
    {
      return on_surface(node, PhysicalId::base) ||
             std::any_of(surfaces[node].begin(), surfaces[node].end(),
                         [&](const int id) { return on_footings.count(id) > 0; });
    }

    /** Returns true if a face with this boundary id belongs to the surface; the base includes the base joints. */
    bool is_on(const int boundary_id, const int surface) const
    {
      return boundary_id == surface || (surface == PhysicalId::base && base_joints.count(boundary_id) > 0);
    }

    /** Returns the position of a free node as "(x, y, z) m", for messages. @p free_node: its number. */
    std::string place_of(unsigned int free_node) const;

    /** Returns the material of a cell. @p materials: one per zone of the mesh (HexMesh::zones), or a single
     * one for all cells. */
    const Material &material_of(unsigned int cell, const std::vector<Material> &materials) const;

    std::unique_ptr<SolidGrid> grid;         ///< cells and faces, for solid_grid.h
    unsigned int               degree;       ///< of the elements
    std::vector<Vector3>       points;       ///< position of each node [m]
    std::vector<unsigned int>  body;         ///< index into body_numbers of each node
    std::vector<int>           body_numbers; ///< physical id of the (first) block of each body, ascending
    std::vector<unsigned int> master; ///< of each node: a node of the same body that moves with it, or itself
    std::size_t n_zones;              ///< number of zones of the mesh, also those without cells in this model
    std::vector<unsigned int>  zone;  ///< index into HexMesh::zones of each active cell
    std::set<int>              base_joints;    ///< boundary ids of the base joints
    std::set<int>              on_footings;    ///< boundary ids of the sides of the dam above footings
    std::set<int>              open_base;      ///< those of free_base_joints()
    std::vector<std::set<int>> surfaces;       ///< boundary ids of each node, and the base at base joints
    std::vector<unsigned int>  equation;       ///< free node number of each node; rigid_ground if fixed
    std::vector<unsigned int>  first_equation; ///< first free node of each body, and the number of free nodes

  private:
    void              find_nodes();
    std::vector<bool> on_base() const;
    std::vector<bool> bonded; ///< node is on a face of the base that is no joint
  };

  /** Assembles the stiffness and the lumped mass (row sums) of all bodies. Elements of degree 2 have 27
   * nodes. Elements of degree 1 have 8 nodes, with incompatible modes (Taylor, Beresford and Wilson
   * 1976) or without.
   * @param model mesh and numbering
   * @param materials one per zone of the mesh, or a single one for all cells
   * @param incompatible_modes whether elements of degree 1 have incompatible modes
   *
   * Throws InputError if an element is so distorted that a nodal mass is not positive. */
  Structure assemble_structure(const SolidModel &model, const std::vector<Material> &materials,
                               bool incompatible_modes);
} // namespace Voussoir

#endif
