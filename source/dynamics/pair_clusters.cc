// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/dynamics/pair_clusters.h>
#include <voussoir/joints/pairs.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  PairClusters::PairClusters(const Structure &structure)
  {
    for (const Matrix3 &m : structure.mass)
      inverse_mass.push_back(inverse(m));
    for (const Pair &pair : structure.pairs)
      pair_inverse.push_back(between(pair, pair));
    std::vector<bool> shares(structure.pairs.size(), false);
    for (auto pairs : clusters_of(structure.pairs))
    {
      // Iterations depend on the sequence. Sorted by inclination, that of most mirror images is the same.
      const auto slope = [&](const unsigned int p)
      { return std::lround(1e6 * std::abs(structure.pairs[p].frame[0][2])); };
      std::stable_sort(pairs.begin(), pairs.end(),
                       [&](const unsigned int p, const unsigned int q) { return slope(p) < slope(q); });
      clusters.push_back({pairs, {}});
      for (const unsigned int p : pairs)
      {
        shares[p] = true;
        for (const unsigned int q : pairs)
          clusters.back().H.push_back(between(structure.pairs[p], structure.pairs[q]));
      }
    }
    for (unsigned int p = 0; p < shares.size(); ++p)
      if (!shares[p])
        single.push_back(p);
  }

  /** Returns G_p M^-1 G_q^T. */
  Matrix3 PairClusters::between(const Pair &p, const Pair &q) const
  {
    Matrix3 H{};
    for (const unsigned int node : {p.node_1, p.node_2})
      for (const unsigned int other : {q.node_1, q.node_2})
        if (node == other && node != rigid_ground)
        {
          const double sign = (node == p.node_2) == (node == q.node_2) ? 1. : -1.;
          for (unsigned int j = 0; j < 3; ++j)
          {
            const Vector3 Mq = inverse_mass[node] * q.frame[j];
            for (unsigned int i = 0; i < 3; ++i)
              H[3 * i + j] += sign * dot(p.frame[i], Mq);
          }
        }
    return H;
  }

  void PairClusters::add_impulse(const Pair &pair, const Vector3 &f, Unknowns &v) const
  {
    Vector3 x;
    for (unsigned int c = 0; c < 3; ++c)
      x[c] = pair.frame[0][c] * f[0] + pair.frame[1][c] * f[1] + pair.frame[2][c] * f[2];
    for (const unsigned int node : {pair.node_1, pair.node_2})
      if (node != rigid_ground)
      {
        const Vector3 kick = inverse_mass[node] * x;
        for (unsigned int c = 0; c < 3; ++c)
          v[3 * node + c] += (node == pair.node_2 ? 1. : -1.) * kick[c];
      }
  }
} // namespace Voussoir
