// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_stress_h
#define voussoir_stress_h

#include <voussoir/solid/material.h>
#include <voussoir/solid/node_faces.h>
#include <voussoir/solid/structure.h>

#include <array>

namespace Voussoir
{
  class NodalMean;
  class SolidModel;

  using Stress = std::array<float, 6>; ///< xx yy zz xy yz zx [Pa], tension > 0

  /** Returns the largest and the smallest principal stress [Pa]. */
  std::array<float, 2> principal_stresses(const Stress &s);

  /** Face of the dam at one of its nodes, see FaceDirections. */
  struct NodeOnFace
  {
    static constexpr unsigned int n_stresses = 3; ///< arch, cantilever, vertical

    unsigned int node;             ///< node of the model
    int          surface;          ///< PhysicalId::upstream or downstream
    Stress       arch, cantilever; ///< factors of the six stress components [-]

    /** Returns the arch, cantilever and vertical stress [Pa]. @p s: stress of the node [Pa]. */
    std::array<float, n_stresses> stresses(const Stress &s) const;
  };

  /** Data of StressKernel. Columns are times of a run or motions of a batch: arrays have n_lanes() values per component,
   * one for each column. */
  struct StressView
  {
    const std::size_t           *start = nullptr;  ///< first block of each node
    const unsigned int          *column = nullptr; ///< free node of each block
    const std::array<float, 18> *block = nullptr, *of_traction = nullptr;
    const std::size_t           *face = nullptr; ///< first face of each node

    const float  *u = nullptr;        ///< displacements, three components per free node [m]
    const float  *traction = nullptr; ///< three components per face [Pa]; null: zero
    const Stress *added = nullptr;    ///< stress of each node to add [Pa]; null: zero

    /** Extremes so far: the largest and the smallest principal stress of each node, and of each NodeOnFace the largest
     * and the smallest arch, cantilever and vertical stress [Pa]. Null: none. */
    const float       *maximum = nullptr, *minimum = nullptr, *of_faces = nullptr;
    float              lowest = 0.f;      ///< larger principal stresses count although below the maximum
    const NodeOnFace  *on_face = nullptr; ///< all nodes on faces
    const std::size_t *first_on_face = nullptr; ///< of each node; null: none

    /** Motions: the extremes have n_lanes() values, too, and the kernel updates those of the faces with their times [s]. */
    bool   by_column = false;
    float *new_of_faces = nullptr, *times_of_faces = nullptr;
    float  time = 0.f;
  };

  /** Computes the stress of a node, six components for all columns [Pa]. Returns the columns that may change an extreme,
   * column t as the bit 2^t. */
  using StressKernel = unsigned int (*)(const StressView &view, std::size_t node, float *stress);

  /** Returns a column of the result of StressKernel. @p lanes: n_lanes(). */
  inline Stress column_of(const float *stress, const unsigned int lanes, const unsigned int column)
  {
    Stress result;
    for (unsigned int c = 0; c < 6; ++c)
      result[c] = stress[lanes * c + column];
    return result;
  }

  /** Returns the kernel for n_lanes(). */
  StressKernel stress_kernel();

  /** Operator from displacements and known face tractions to nodal stresses, as sparse matrix products.
   *
   * The stress of a node is obtained in these steps:
   * 1. stress in each cell by CellElasticity::stress_operator();
   * 2. mean over the cells of the same monolith around the node; at an interface of materials only over those
   *    of the stiffest material, which has the largest stress along the interface;
   * 3. on request, extrapolation of the tractions on the base to its nodes (NodalMean);
   * 4. at nodes of faces with known tractions, the nearest stress with these tractions; strains parallel to
   *    the faces are unchanged (TractionCondition).
   *
   * The operator is stored and applied in single precision, with a relative error of 1e-7, because it is
   * applied at every recorded step. The stresses of a column do not depend on the other columns of a StressView. */
  class StressRecovery
  {
  public:
    /** @param model mesh of the bodies
     * @param materials as in assemble_structure()
     * @param incompatible_modes as in assemble_structure()
     * @param faces faces with known tractions, sorted by node
     * @param to_base whether to extrapolate the tractions to the base */
    StressRecovery(const SolidModel &model, const std::vector<Material> &materials, bool incompatible_modes,
                   const std::vector<NodeFace> &faces = {}, bool to_base = false);

    /** Computes the stress of all nodes.
     * @param u displacement, three values per free node [m]
     * @param tractions force per area on each of the faces [Pa]; empty: all zero
     * @param stress receives one stress per node of the model [Pa] */
    void apply(const Unknowns &u, const std::vector<Vector3> &tractions, std::vector<Stress> &stress) const;

    /** Returns a view with the operator only. */
    StressView view() const;

    double memory() const { return 4. * 18. * (blocks.size() + of_traction.size()); } ///< [bytes]

  private:
    void find_columns(const SolidModel &model, const NodalMean &mean);
    void add_cells(const SolidModel &model, const std::vector<Material> &materials, bool incompatible_modes,
                   const NodalMean &mean);
    void condition(const std::vector<NodeFace> &faces, const NodalMean &mean);
    std::array<float, 18> &block(unsigned int node, unsigned int free_node);

    std::vector<std::size_t>           start;
    std::vector<unsigned int>          column; ///< free node of each block
    std::vector<std::array<float, 18>> blocks; ///< stress component 0..5 by displacement component x, y, z
    std::vector<std::array<float, 18>> of_traction; ///< per face: stress of its node by traction
    std::vector<std::size_t>           face;        ///< first face of each node
  };
} // namespace Voussoir

#endif
