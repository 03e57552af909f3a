// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_dam_geometry_h
#define voussoir_dam_geometry_h

#include <voussoir/solid/solid_model.h>

#include <functional>

namespace Voussoir
{
  /** Crest, crown and upper ends of the joints, for results. */
  class DamGeometry
  {
  public:
    /** Finds these points. If the surfaces "crest" and "upstream" have no common edge, the highest nodes replace it.
     * @p source: name of the mesh in messages. Throws InputError if this is a single node. */
    DamGeometry(const SolidModel &model, const std::vector<Pair> &pairs, unsigned int n_joints,
                const std::string &source);

    bool has_crest; ///< false: the mesh has no common edge of "crest" and "upstream"

    /** Returns the arc length along the upstream edge of the crest [m], for the point of the edge that is
     * nearest to
     * @p p in plan. It is zero in the middle and positive towards the left bank. */
    double arc_length(const Vector3 &p) const;

    /** Node of the upstream edge of the crest nearest to the middle. With equal distances, or at a joint, it
     * is the node towards the right bank. */
    unsigned int crown;
    unsigned int crown_left; ///< node on the other side of a joint at the crown, otherwise @p crown

    /** Highest pairs of a joint. */
    struct CrestPairs
    {
      unsigned int upstream = rigid_ground,
                   downstream = rigid_ground; ///< pair numbers; rigid_ground: the joint has no pairs
      double arc_length = 0.;                 ///< of the upstream pair [m]
    };
    std::vector<CrestPairs> joints; ///< one entry per joint

  private:
    void find_crown(const SolidModel &model, const std::vector<unsigned int> &nodes);

    std::vector<Vector3> edge; ///< upstream edge of the crest, from the right bank
    std::vector<double>  at;   ///< arc length at the points of @p edge [m]
  };

  /** Point in an element of the dam. */
  struct PlaceInDam
  {
    Vector3                                      point{};   ///< [m]
    int                                          block = 0; ///< physical id of the volume
    std::vector<std::pair<unsigned int, double>> parts;     ///< nodes, and their shape functions at the point

    /** Returns the interpolated value of a vector. @p at_node: returns its value at a node. */
    Vector3 interpolated(const std::function<Vector3(unsigned int)> &at_node) const;
  };

  /** Returns the points of the dam nearest to @p p, in the elements: one for each block that meets there, in the
   * order of their numbers, from the right bank. Throws InputError, which begins with @p what, if they are farther away
   * than the diagonal of their element. */
  std::vector<PlaceInDam> places_at(const SolidModel &model, const std::string &what, const Vector3 &p);

  /** Returns the first of these points for the probe @p name. */
  PlaceInDam probe_place(const SolidModel &model, const std::string &name, const Vector3 &p);
} // namespace Voussoir

#endif
