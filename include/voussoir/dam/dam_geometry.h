// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_dam_geometry_h
#define voussoir_dam_geometry_h

#include <voussoir/solid/solid_model.h>

namespace Voussoir
{
  /** The places of a dam that engineers look at. */
  class DamGeometry
  {
  public:
    /** Throws InputError when the mesh has no surface "crest". */
    DamGeometry(const SolidModel &model, const std::vector<Pair> &pairs, unsigned int n_joints);

    /** Arc length along the upstream edge of the crest, zero in its middle, positive to the left bank, of the
     * point of that edge that is nearest in plan [m]. */
    double arc_length(const dealii::Point<3> &p) const;

    /** Node of the crest's upstream edge that is nearest to its middle. At equal distances: the node towards
     * the right bank. Where a joint ends there: the node of the monolith towards the right bank. */
    unsigned int crown;
    unsigned int crown_left; ///< node on the other side of a joint that ends at the crown, else crown

    struct CrestPairs
    {
      unsigned int upstream = rigid_ground,
                   downstream = rigid_ground; ///< pairs; rigid_ground if the joint has none
      double arc_length = 0.;
    };
    std::vector<CrestPairs> joints;

  private:
    void find_crown(const SolidModel &model, const std::vector<unsigned int> &nodes);

    std::vector<dealii::Point<3>> edge; ///< upstream edge of the crest from the right bank to the left
    std::vector<double>           at;   ///< its arc length
  };

  /** The node nearest to a point. */
  unsigned int nearest_node(const SolidModel &model, const dealii::Point<3> &p);

  /** The node nearest to the probe @p name at @p p. Throws InputError if it is farther away than the elements
   *  there are large (the longest distance from that node to another one of its elements). */
  unsigned int probe_node(const SolidModel &model, const std::string &name, const dealii::Point<3> &p);

  /** The same for @p what, as messages name it: "Entry ... : probe ...". */
  unsigned int node_at(const SolidModel &model, const std::string &what, const dealii::Point<3> &p);
} // namespace Voussoir

#endif
