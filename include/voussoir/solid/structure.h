// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_structure_h
#define voussoir_structure_h

#include <voussoir/base/node_matrix.h>
#include <voussoir/base/ranks.h>
#include <voussoir/solid/damping.h>

#include <string>

namespace Voussoir
{
  /** Linear elastic body: its stiffness and the position of its nodes in the numbering of the structure. */
  struct Body
  {
    int               number = 0;     ///< physical id of its (first) block
    unsigned int      first_node = 0; ///< its nodes are first_node .. first_node + stiffness.n_rows() - 1
    BlockSparseMatrix stiffness;      ///< [N/m], free nodes only
    BlockSparseMatrix damped;         ///< K_c of Damping [N/m], on a part of its pattern; empty: K_c = K

    /** Reaction of the water to a change of the displacement in a time step [N/m], on the pattern of the stiffness;
     * empty: none. The force of the water at the end of the step is the load minus the reaction times the change. */
    std::vector<Matrix3>      reaction;
    std::vector<unsigned int> reacting;  ///< rows of the reaction that are not zero
    std::vector<unsigned int> interface; ///< local numbers of the nodes in pairs, ascending

    unsigned int n_nodes() const { return stiffness.n_rows(); }

    /** Returns the name for messages, as "monolith 3" or "monolith 3 lift 2". */
    std::string name() const;
  };

  /** Node number of the rigid ground, whose displacement is zero. */
  constexpr unsigned int rigid_ground = static_cast<unsigned int>(-1);

  /** Pair of coincident nodes on both sides of a joint. The displacement of side 2 relative to side 1 is
   * G u = R (u_2 - u_1), where R has the rows #frame. */
  struct Pair
  {
    unsigned int           node_1 = rigid_ground, node_2 = rigid_ground; ///< free nodes, or rigid_ground
    std::array<Vector3, 3> frame;                  ///< n (from side 1 to side 2), a, b; {n,a,b} right-handed
    double                 area = 1.;              ///< tributary area [m^2]
    Vector3                place = {{0., 0., 0.}}; ///< position [m]
    unsigned int           joint = 0;              ///< index of its joint
    bool                   is_base = false;        ///< in a base joint: side 1 is the ground

    /** Axes of each plane that meets at an edge of the joint: n and two tangents as rows, in the frame of the
     * pair. The first plane has the frame of the pair. Empty if the joint is smooth here. */
    std::vector<Matrix3> planes;
  };

  /** Linear part of the model: bodies, masses, damping and the pairs between bodies. Fixed nodes are not
   * included. Displacements are relative to the base or absolute, depending on the foundation. */
  struct Structure
  {
    std::vector<Body>    bodies;     ///< sorted by node, without gaps
    Shares               share;      ///< distribution of the bodies over the ranks; see collect_interfaces()
    std::vector<Matrix3> mass;       ///< lumped mass per node, with added mass [kg]
    std::vector<Matrix3> added_mass; ///< added mass of the water per node [kg]
    std::vector<Pair>    pairs;      ///< sorted by group
    unsigned int         n_joints = 0;

    /** Group of each joint: a block of the joint operator. Joints of a group are solved together, so that an arch with
     * base and lift joints is a chain of groups. Empty: each joint is a group. */
    std::vector<unsigned int> group_of_joint;

    /** Clusters of pairs that share nodes, where joints cross; see clusters_of(). */
    std::vector<std::vector<unsigned int>> clusters;
    Damping                                damping;
    bool plane_strain = false; ///< true: displacements along y are zero, see decouple_y()

    unsigned int n_nodes() const { return static_cast<unsigned int>(mass.size()); }

    /** Returns the group of a pair. */
    unsigned int group(const Pair &pair) const
    {
      return group_of_joint.empty() ? pair.joint : group_of_joint[pair.joint];
    }

    /** Returns the number of groups. */
    unsigned int n_groups() const;

    /** Determines the interface nodes of the bodies and distributes the bodies over the ranks. Call once,
     * after bodies and pairs are complete. */
    void collect_interfaces();

    /** Decouples the displacements along y in stiffness and mass, for plane strain: only the diagonal remains in
     * their rows and columns. Without loads along y they are exactly zero. */
    void decouple_y();

    /** Removes the forces along y from a load if #plane_strain is true, three values per node. */
    void remove_held_forces(Unknowns &load) const;

    /** Returns the index of the body that contains a node. */
    unsigned int body_of(unsigned int node) const;

    /** Computes stiffness, or another @p matrix, times displacement for all bodies [N]. */
    void multiply_stiffness(const Unknowns &u, Unknowns &Ku,
                            BlockSparseMatrix Body::*matrix = &Body::stiffness) const;

    /** Returns true if zones of the dam have different damping ratios. */
    bool has_zones() const { return !bodies.empty() && bodies[0].damped.n_rows() > 0; }

    /** Returns K_c u of Damping [N], or an empty vector if K_c is K. */
    Unknowns damped_force(const Unknowns &u) const;

    /** Adds @p factor times the reaction of the water (Body::reaction) to @p u, to y [N]. */
    void add_reaction(double factor, const Unknowns &u, Unknowns &y) const;

    /** Distributes a vector of which each rank has computed the part of its bodies, three values per node. */
    void gather(Unknowns &u) const;

    /** Returns the relative displacement R (u_2 - u_1) of a pair, in its frame. */
    Vector3 jump(const Pair &pair, const Unknowns &u) const;

    /** Adds a joint force to both nodes of a pair: u_2 += R^T f, u_1 -= R^T f. @p f: components in the frame
     * (n, a, b) of the pair. */
    void add_pair_force(const Pair &pair, const Vector3 &f, Unknowns &u) const;
  };
} // namespace Voussoir

#endif
