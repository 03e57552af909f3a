// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_crossings_h
#define voussoir_crossings_h

#include <voussoir/joints/interface_operator.h>

namespace Voussoir
{
  /** Second stage of the preconditioner of JointJacobian where joints cross. Pairs that share nodes are coupled as
   * strongly as a pair with itself, also between joints. One iteration of the block Jacobi method over the clusters of
   * such pairs corrects the result of the Gauss-Seidel iteration over the joints.
   *
   * Single precision. Each process has the blocks of all clusters, and the columns for the rows of its groups. Without
   * clusters the stage is empty. */
  class Crossings
  {
  public:
    explicit Crossings(const InterfaceOperator &W); ///< @p W must outlive the object

    bool is_empty() const { return clusters.empty(); }

    /** Inverts the blocks of the clusters in J = d_force + d_gap W. @p equations: one per pair. */
    void invert(const std::vector<PairEquations> &equations);

    /** Corrects @p z, an approximation of J^-1 v, and @p Wz = W z.
     * @param equations those of invert()
     * @param v right-hand side, three values per pair */
    void correct(const std::vector<PairEquations> &equations, const std::vector<float> &v,
                 std::vector<float> &z, std::vector<float> &Wz) const;

  private:
    struct Cluster
    {
      std::vector<unsigned int> pairs;
      std::vector<float>        W;       ///< block of the cluster, by row
      std::vector<float>        inverse; ///< of the block in J, by column
      int                       n() const { return 3 * static_cast<int>(pairs.size()); }
    };
    /** Columns of W between two groups that belong to clusters. */
    struct Columns
    {
      unsigned int       from;
      std::vector<float> value; ///< by column
    };
    void add_rows(unsigned int p, const std::vector<unsigned int> &group, Cluster &cluster) const;
    void copy_columns(unsigned int to, unsigned int from);

    const InterfaceOperator &W;
    std::vector<Cluster>     clusters;
    std::vector<std::vector<unsigned int>>
                                      unknowns; ///< of each group: those in clusters, relative to its first
    std::vector<std::vector<Columns>> columns;  ///< by the group of the rows
  };
} // namespace Voussoir

#endif
