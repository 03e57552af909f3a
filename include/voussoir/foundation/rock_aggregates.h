// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_aggregates_h
#define voussoir_rock_aggregates_h

#include <voussoir/base/node_matrix.h>

#include <map>

namespace Voussoir
{
  /** Rigid body motion: three translations, then three rotations times the size of the body. Also the dual
   * quantity: three forces, then three moments divided by the size. */
  using RigidMotion = std::array<double, 6>;

  /** Groups of neighbouring nodes that move as rigid bodies: coarse space for the equilibrium of the rock. It
   * is the tentative prolongation of smoothed aggregation (Vanek, Mandel and Brezina 1996, Computing 56). A
   * node whose neighbours are in no group forms a group with all of them. Each remaining node joins the group
   * of its most strongly coupled neighbour. The groups do not depend on the number of ranks. */
  class RockAggregates
  {
  public:
    static constexpr unsigned int none = static_cast<unsigned int>(-1); ///< group of held nodes

    /** Forms the groups of all nodes that are not @p held.
     *
     * @param stiffness stiffness matrix of the rock [N/m]
     * @param points positions of the nodes [m]
     * @param held nodes with zero displacement
     * @param strong least coupling of two nodes of one group, at least 1e-8: the squared norm of their block of
     * the stiffness matrix over the geometric mean of those of the diagonal blocks [-]. The four strongest
     * couplings of each node are strong, too */
    RockAggregates(const BlockSparseMatrix &stiffness, const std::vector<Vector3> &points,
                   const std::vector<bool> &held, double strong);

    /** Returns the number of aggregates. */
    unsigned int n() const { return static_cast<unsigned int>(members.size()); }

    /** Returns the aggregate of a node, or RockAggregates::none if the node is held. */
    unsigned int of_node(const unsigned int node) const { return group[node]; }

    /** Returns the nodes of an aggregate, ascending. */
    const std::vector<unsigned int> &nodes(const unsigned int aggregate) const { return members[aggregate]; }

    /** Returns the central node of an aggregate. All its nodes are within two layers of neighbours. */
    unsigned int seed(const unsigned int aggregate) const { return seeds[aggregate]; }

    /** Returns the displacement of a node for the rigid body @p motion of its aggregate [m]. */
    Vector3 displacement(unsigned int node, const RigidMotion &motion) const;

    /** Adds the @p force on a node to the resultant @p sum of its aggregate. */
    void add_force(unsigned int node, const Vector3 &force, RigidMotion &sum) const;

    /** Returns the motions of all aggregates for a rigid body motion of the whole rock. @p mode: 0 to 2
     * translations, 3 to 5 rotations about the centre. */
    std::vector<RigidMotion> rigid(unsigned int mode) const;

  private:
    std::vector<unsigned int>              seeds;   ///< central node of each aggregate
    std::vector<unsigned int>              group;   ///< aggregate of each node
    std::vector<std::vector<unsigned int>> members; ///< nodes of each aggregate
    std::vector<Vector3> centre, arm; ///< of the aggregates [m]; from centre to node, divided by the size [-]
    std::vector<double>  size;        ///< largest distance of a node from the centre [m]
  };

  /** Stiffness of springs to the ground by node [N/m]. */
  using NodeSprings = std::map<unsigned int, Matrix3>;

  /** Prolongation smoother S = 1 - damping D^-1 K, with the diagonal blocks D of the stiffness matrix K. */
  struct RockSmoothing
  {
    const BlockSparseMatrix    &stiffness;
    const NodeSprings          &springs; ///< part of K
    const std::vector<Matrix3> &inverse; ///< of the diagonal blocks, zero at held nodes [m/N]
    double                      damping; ///< damping factor [-]
  };

  /** Stiffness between two aggregates, in single precision for a preconditioner. The size is that of 19
   * doubles, because ranks exchange blocks as doubles. */
  struct alignas(double) CoarseBlock
  {
    unsigned int          row, column; ///< numbers of the aggregates
    std::array<float, 36> value;       ///< row by row
  };

  /** Returns the rows of P^T K P for the aggregates in @p wanted. P is the smoother S times the rigid body
   * motions of the aggregates. A row requires the rows of the stiffness matrix within four layers of elements
   * around the seed of the aggregate. */
  std::vector<CoarseBlock> coarse_rows(const RockAggregates &aggregates, const RockSmoothing &smoothing,
                                       const std::vector<unsigned int> &wanted);
} // namespace Voussoir

#endif
