// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_structure_h
#define voussoir_structure_h

#include <voussoir/base/node_matrix.h>
#include <voussoir/base/ranks.h>

namespace Voussoir
{
  /** One linear elastic body: its stiffness, and where its nodes lie in the structure's numbering. */
  struct Body
  {
    int               number = 0;        ///< monolith, as messages name it
    unsigned int      first_node = 0;    ///< its nodes are first_node .. first_node + stiffness.n_rows() - 1
    BlockSparseMatrix stiffness;         ///< [N/m], free nodes only
    std::vector<unsigned int> interface; ///< local numbers of the nodes that belong to pairs, ascending

    unsigned int n_nodes() const { return stiffness.n_rows(); }
  };

  constexpr unsigned int rigid_ground = static_cast<unsigned int>(-1);

  /** A pair of coincident nodes of a joint. The jump across it is G u = R (u_2 - u_1). */
  struct Pair
  {
    unsigned int           node_1 = rigid_ground, node_2 = rigid_ground; ///< free nodes, or the rigid ground
    std::array<Vector3, 3> frame;                  ///< n (from side 1 to side 2), a, {n,a,b} right-handed
    double                 area = 1.;              ///< tributary area [m^2]
    Vector3                place = {{0., 0., 0.}}; ///< position [m]
    unsigned int           joint = 0;              ///< index of its joint
    /** On an edge of the joint: axes (n, two tangents; rows) of each plane that meets there, in the frame of
     *  the pair, which is that of the first of them. Empty where the joint is smooth. */
    std::vector<Matrix3> planes;
  };

  /** Everything linear: bodies, masses, damping; and the pairs along which the bodies meet.
   *  Fixed nodes do not exist here; displacements are relative to the moving base. */
  struct Structure
  {
    std::vector<Body>    bodies;     ///< contiguous and ascending in their nodes
    Shares               share;      ///< of the bodies: which rank does their work; collect_interfaces()
    std::vector<Matrix3> mass;       ///< per node, lumped, with the added mass of the water [kg]
    std::vector<Matrix3> added_mass; ///< per node, that of the water alone [kg]
    Unknowns             dashpots;   ///< viscous dashpots to the ground per component [N s/m]; empty = none
    std::vector<Pair>    pairs;      ///< sorted by joint
    unsigned int         n_joints = 0;
    double mass_damping = 0.;      ///< Rayleigh: C = mass_damping M + stiffness_damping K + dashpots [1/s]
    double stiffness_damping = 0.; ///< [s]

    unsigned int n_nodes() const { return static_cast<unsigned int>(mass.size()); }

    /** Mark the nodes of the pairs as interface of their bodies, and share out the bodies. Call once when
     * bodies and pairs are there. */
    void collect_interfaces();

    /** The body of a node. */
    unsigned int body_of(unsigned int node) const;

    /** Stiffness times displacement, all bodies [N]. */
    void multiply_stiffness(const Unknowns &u, Unknowns &Ku) const;

    /** All ranks get what each has made of @p u, three values per node, for its bodies. */
    void gather(Unknowns &u) const;

    /** R (u_2 - u_1) of a pair. */
    Vector3 jump(const Pair &pair, const Unknowns &u) const;

    /** u_2 += R^T f, u_1 -= R^T f: the joint force f = (n, a, b) on both sides of the pair. */
    void add_pair_force(const Pair &pair, const Vector3 &f, Unknowns &u) const;
  };
} // namespace Voussoir

#endif
