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

  /** Returns true if the largest principal stress is above @p high or the smallest one below @p low [Pa], at a fraction
   * of the cost of principal_stresses(). */
  bool exceeds(const Stress &s, float high, float low);

  /** Displacements and known face tractions at up to n_times times. StressRecovery computes the stresses at these
   * times together, because it then reads its operator only once. */
  struct StressInput
  {
    static constexpr unsigned int n_times = 8;

    /** Adds a time.
     * @param at_free_nodes displacement, three values per free node [m]
     * @param of_faces force per area on each of the faces [Pa]; empty: all zero */
    void add(const Unknowns &at_free_nodes, const std::vector<Vector3> &of_faces);

    unsigned int                              n = 0;     ///< number of times
    std::vector<float>                        u;         ///< displacements: n_times values per component [m]
    std::array<std::vector<Vector3>, n_times> tractions; ///< of the faces at each time [Pa]
  };

  /** Stress of each node of the model at each time of a StressInput [Pa]. */
  using StressesInTime = std::array<std::vector<Stress>, StressInput::n_times>;

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
   * applied at every recorded step. The stresses at a time do not depend on the other times of a StressInput. */
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

    /** Computes the stresses of the nodes @p first to @p last - 1 at all times of @p input. */
    void apply(const StressInput &input, std::size_t first, std::size_t last, StressesInTime &stress) const;

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
    std::vector<std::array<float, 18>> of_traction;  ///< per face: stress of its node by traction
    std::vector<unsigned int>          node_of_face; ///< node of each face
  };
} // namespace Voussoir

#endif
