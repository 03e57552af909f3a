// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_layout_h
#define voussoir_joint_layout_h

#include <voussoir/dam/scene.h>
#include <voussoir/joints/joint_laws.h>

#include <set>

namespace Voussoir
{
  class SolidModel;

  /** Joints of a dam: their models, gaps and laws, and what holds where they cross each other or the base. */
  class JointLayout
  {
  public:
    /** @param scene input file; must outlive the object
     * @param tie_all true: all joints are tied, for natural frequencies */
    JointLayout(const Scene &scene, const bool tie_all) : scene(scene), tie_all(tie_all) {}

    /** Opens the joints of a mesh of monoliths, without lifts whose joints are tied, with footings below open base
     * joints on rock. Sets the members. Throws InputError if mesh and input file do not fit.
     * @param source name of the mesh for messages */
    HexMesh open(const HexMesh &concrete, const std::string &source);

    /** Returns the indices in #joints of the joints with this number, name or kind. Throws InputError if there are
     * none; @p what is the beginning of the message. */
    std::vector<std::size_t> named(const std::string &key, const std::string &what) const;

    /** Returns true if monoliths have joints inside: lift joints, or base joints on footings. */
    bool has_parts() const;
    /** Ties the joints inside monoliths: all, or those with the model "tied". */
    void tie_parts(SolidModel &model, bool all) const;

    /** Returns the surfaces of the base joints that are not tied. */
    std::set<int> open_bases() const;

    /** Groups and sorts the pairs: the lift and base joints of monolith m belong to the contraction joint m - 1. */
    void group_by_monolith(Structure &structure) const;

    /** Finds the clusters of pairs where joints cross. */
    void cross(Structure &structure);

    /** Assigns the laws of the pairs. Pairs between @p tied_nodes are tied. Throws InputError if laws or crossings
     * exclude the impact rule. */
    void assign_laws(const Structure &structure, const std::set<unsigned int> &tied_nodes);

    /** Returns true if the joint of a pair is cast, not grouted: a base or lift joint. */
    bool is_cast(const Pair &pair) const { return !joints[pair.joint].is_contraction(); }

    std::vector<Joint>       joints;            ///< all joints, by number
    std::vector<std::string> models;            ///< names of the laws of #joints
    std::vector<double>      gaps;              ///< initial gaps of #joints [m]
    unsigned int             n_contraction = 0; ///< number of contraction joints, also if they are tied
    bool                     tied = false;      ///< true: all joints are tied, without pairs

    std::set<unsigned int> without_keys; ///< joints KSM that are flat where joints cross

    bool has_open_bases = false, has_open_lifts = false; ///< joints that are not tied

    /** Laws of all pairs. JointLaws::of_joint has the law of each joint, then the law of tied pairs at the base. */
    JointLaws laws;

  private:
    void choose_laws();

    const Scene &scene;
    const bool   tie_all;
    std::set<std::string>
        merged_lifts; ///< keys of all joints, if lifts were merged because all lift joints are tied
  };
} // namespace Voussoir

#endif
