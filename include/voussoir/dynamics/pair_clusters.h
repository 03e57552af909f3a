// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_pair_clusters_h
#define voussoir_pair_clusters_h

#include <voussoir/solid/structure.h>

namespace Voussoir
{
  /** Effect of pair impulses on velocity jumps, H = G M^-1 G^T, by clusters: pairs that share nodes. The mass matrix is
   * lumped with one 3x3 block per node. The structure must outlive the object. */
  class PairClusters
  {
  public:
    /** Pairs that share nodes, directly or through other pairs. */
    struct Cluster
    {
      std::vector<unsigned int> pairs;
      std::vector<Matrix3>      H; ///< between its pairs, by row [1/kg]
      const Matrix3            &between(const std::size_t i, const std::size_t j) const
      {
        return H[i * pairs.size() + j];
      }
    };

    /** Inverts the masses. */
    explicit PairClusters(const Structure &structure);

    /** Adds M^-1 G^T f of one pair to the velocity @p v. @p f: impulse in the frame of the pair [N s]. */
    void add_impulse(const Pair &pair, const Vector3 &f, Unknowns &v) const;

    const std::vector<Matrix3> &inverse_masses() const { return inverse_mass; }   ///< per node [1/kg]
    const Matrix3 &of_pair(const std::size_t p) const { return pair_inverse[p]; } ///< H of a pair [1/kg]

    std::vector<Cluster>      clusters;
    std::vector<unsigned int> single; ///< pairs that share no nodes

  private:
    Matrix3 between(const Pair &p, const Pair &q) const;

    std::vector<Matrix3> inverse_mass; ///< per node
    std::vector<Matrix3> pair_inverse; ///< per pair
  };
} // namespace Voussoir

#endif
