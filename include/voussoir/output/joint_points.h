// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_points_h
#define voussoir_joint_points_h

#include <voussoir/dam/dam_geometry.h>

#include <string>

namespace Voussoir
{
  /** A value with its place and time. */
  struct Extreme
  {
    double  value = 0., time = 0.;
    Vector3 place = {{0., 0., 0.}};

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

  /** Openings and slips at all pairs of the joints over time, and at their waterstops: points at a distance
   * from the upstream face, between whose neighbouring pairs openings and slips are linear. */
  class JointPoints
  {
  public:
    JointPoints() = default;

    /** @p depth: of the waterstops from the upstream face [m]. Where a joint is thinner it has none. */
    JointPoints(const SolidModel &model, const std::vector<Pair> &pairs, unsigned int n_joints, double depth);

    /** Opening and slip (n, a, b) of a pair [m]; all pairs of a time, then end_record(). */
    void record(unsigned int pair, const Vector3 &moved);
    void end_record(double time);

    /** joint_points.csv and joint_cells.csv: a line for each pair, and quadrilaterals between them. */
    void write(const std::string &directory, const DamGeometry &geometry) const;

    /** The largest that remains at the last time. */
    Extreme residual(bool slip) const;

    bool has_waterstops() const { return !waterstops.empty(); }

    /** Height at the top of a joint over which it is thinner than the waterstop is deep, the largest of the
     * joints, and the number of that joint; 0 where all waterstops reach the top [m]. */
    std::pair<double, unsigned int> height_without_waterstop() const;

    Extreme waterstop_opening, waterstop_slip;

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
      unsigned int                joint;
    };
    struct Between
    {
      unsigned int from, to; ///< pairs
      double       share;    ///< of the second
    };
    std::vector<Pair>                                pairs;
    std::vector<Quad>                                quads;
    std::vector<std::vector<std::array<Vector3, 2>>> rims;  ///< of each joint: edges on the upstream face [m]
    std::vector<double>                              depth; ///< of the pairs [m]
    std::vector<Between>                             waterstops;    ///< points
    std::vector<Vector3>                             now;           ///< of the pairs
    std::vector<double>                              opening, slip; ///< the largest so far [m]
    double                                           last_time = 0.;
  };
} // namespace Voussoir

#endif
