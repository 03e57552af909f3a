// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_points_h
#define voussoir_joint_points_h

#include <voussoir/dam/dam_geometry.h>

#include <string>

namespace Voussoir
{
  /** Largest value with its position [m] and time [s]. */
  struct Extreme
  {
    double  value = 0., time = 0.;
    Vector3 place = {{0., 0., 0.}};

    /** Replaces the value if the @p other one is larger. */
    void raise(const double other, const double at, const Vector3 &there)
    {
      if (other > value)
        *this = {other, at, there};
    }

    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &value &time &place[0] & place[1] & place[2];
    }
  };

  /** Openings and slips at all pairs of the joints, and at their waterstops. The waterstops are at a given
   * distance from the upstream face. Openings and slips are linear between neighbouring pairs. */
  class JointPoints
  {
  public:
    JointPoints() = default;

    /** Finds the waterstops. @p depth: distance of the waterstops from the upstream face [m]. Thinner parts
     * of a joint have no waterstop. */
    JointPoints(const SolidModel &model, const std::vector<Pair> &pairs, unsigned int n_joints, double depth);

    /** Adds opening and slip (n, a, b) of a pair to the record [m]. */
    void record(unsigned int pair, const Vector3 &moved);

    /** Ends the record at @p time [s], after all pairs were added. */
    void end_record(double time);

    /** Writes joint_points.csv with one line per pair, and joint_cells.csv with the quadrilaterals. */
    void write(const std::string &directory, const DamGeometry &geometry) const;

    /** Returns the largest slip or opening at the last time [m]. */
    Extreme residual(bool slip) const;

    /** Returns true if any joint has a waterstop. */
    bool has_waterstops() const { return !waterstops.empty(); }

    /** Returns the largest height at the top of a joint without waterstop [m], and the number of this joint.
     * The height is 0 if all waterstops reach the top. */
    std::pair<double, unsigned int> height_without_waterstop() const;

    Extreme waterstop_opening, waterstop_slip; ///< largest values at the waterstops [m]

    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &opening &slip &waterstop_opening &waterstop_slip &last_time;
      for (Vector3 &moved : now) // as many as there are pairs
        archive &moved[0] & moved[1] & moved[2];
    }

  private:
    void   find_waterstops(double at);
    double distance(const Vector3 &p, unsigned int joint) const;

    struct Quad
    {
      std::array<unsigned int, 4> pairs;
      unsigned int                joint; ///< counted from 0
    };

    /** Point between two pairs. */
    struct Between
    {
      unsigned int from, to; ///< pairs
      double       share;    ///< relative position, 0 at @p from, 1 at @p to [-]
    };
    std::vector<Pair>                                pairs;
    std::vector<Quad>                                quads;
    std::vector<std::vector<std::array<Vector3, 2>>> rims; ///< edges of each joint on the upstream face [m]
    std::vector<double>  depth;         ///< distances of the pairs from the upstream face [m]
    std::vector<Between> waterstops;    ///< points of the waterstops
    std::vector<Vector3> now;           ///< opening and slip of the pairs [m]
    std::vector<double>  opening, slip; ///< largest values so far [m]
    double               last_time = 0.;
  };
} // namespace Voussoir

#endif
