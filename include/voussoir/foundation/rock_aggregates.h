// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_aggregates_h
#define voussoir_rock_aggregates_h

#include <voussoir/base/node_matrix.h>

namespace Voussoir
{
  /** Six motions of a rigid body: translations, then rotations times its size. Also forces and moments over
   * the size. */
  using RigidMotion = std::array<double, 6>;

  /** Groups of neighbouring nodes that move as rigid bodies, a coarse space for the equilibrium of the rock:
   * the tentative prolongation of smoothed aggregation (Vanek, Mandel and Brezina 1996, Computing 56). A node
   * whose neighbours are in no group yet makes one of them all; who is left joins the neighbour to whom it is
   * tied most. They follow from the mesh alone, not from the number of ranks. */
  class RockAggregates
  {
  public:
    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    /** Of the nodes of @p stiffness [N/m], at @p points [m], that are not @p held. */
    RockAggregates(const BlockSparseMatrix &stiffness, const std::vector<Vector3> &points,
                   const std::vector<bool> &held);

    unsigned int n() const { return static_cast<unsigned int>(members.size()); }
    unsigned int of_node(const unsigned int node) const { return group[node]; } ///< none: it is held

    /** Its nodes, ascending. */
    const std::vector<unsigned int> &nodes(const unsigned int aggregate) const { return members[aggregate]; }

    /** The node that it was made around: its nodes are neighbours of this one, or of its neighbours. */
    unsigned int seed(const unsigned int aggregate) const { return seeds[aggregate]; }

    /** Of a node, with its aggregate's @p motion. */
    Vector3 displacement(unsigned int node, const RigidMotion &motion) const;

    /** The @p force on a node counts in its aggregate's @p sum. */
    void add_force(unsigned int node, const Vector3 &force, RigidMotion &sum) const;

    /** All aggregates' motions when the whole moves as a rigid body in the way @p mode, about its centre. */
    std::vector<RigidMotion> rigid(unsigned int mode) const;

  private:
    std::vector<unsigned int>              seeds;
    std::vector<unsigned int>              group; ///< of each node
    std::vector<std::vector<unsigned int>> members;
    std::vector<Vector3>                   centre, arm; ///< of aggregates [m]; of nodes, over the size
    std::vector<double>                    size;        ///< [m]
  };

  /** What makes smooth motions of the aggregates: S = 1 - damping D^-1 K, with the blocks D of K's diagonal.
   */
  struct RockSmoothing
  {
    const BlockSparseMatrix    &stiffness;
    const std::vector<Matrix3> &inverse; ///< of the diagonal's blocks; zero where the rock is held [m/N]
    double                      damping;
  };

  /** Stiffness between two aggregates: as many bytes as 19 doubles, to be sent. Single precision, since it
   * serves a preconditioner only, and the first rank has all of them. */
  struct alignas(double) CoarseBlock
  {
    unsigned int          row, column; ///< numbers of the aggregates
    std::array<float, 36> value;       ///< row by row
  };

  /** Rows of P^T K P for the aggregates in @p wanted, where P is S times the motions of the aggregates.
   * Each is computed alone, from the nodes around it: from rows of the stiffness within four layers of cells
   * around the aggregate's seed. */
  std::vector<CoarseBlock> coarse_rows(const RockAggregates &aggregates, const RockSmoothing &smoothing,
                                       const std::vector<unsigned int> &wanted);
} // namespace Voussoir

#endif
