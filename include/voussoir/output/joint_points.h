// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_points_h
#define voussoir_joint_points_h

#include <voussoir/dam/dam_geometry.h>

#include <string>

namespace Voussoir
{
  /** Largest value with its position and time. */
  struct Extreme
  {
    double  value = 0.;             ///< largest value
    double  time = 0.;              ///< time of the value [s]
    Vector3 place = {{0., 0., 0.}}; ///< position of the value [m]

    /** Replaces the value if another value is larger.
     * @param other the other value
     * @param at time of the other value [s]
     * @param there position of the other value [m] */
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

    /** Finds the waterstops.
     * @param model mesh of the dam
     * @param pairs pairs of all joints
     * @param n_joints number of joints
     * @param depth distance of the waterstops from the upstream face [m]. Parts of a joint that are thinner
     * have no waterstop. */
    JointPoints(const SolidModel &model, const std::vector<Pair> &pairs, unsigned int n_joints, double depth);

    /** Adds a pair to the record of one time. @p pair: index of the pair. @p moved: opening and two slips of
     * the pair in its frame (n, a, b) [m]. */
    void record(unsigned int pair, const Vector3 &moved);

    /** Ends the record of one time, after all pairs were added. @p time: present time [s]. */
    void end_record(double time);

    /** Writes joint_points.csv with one line per pair, and joint_cells.csv with the quadrilaterals. @p at_start: of each
     * pair in the static state, pressure [Pa], opening and distance of the concrete faces [m]. */
    void write(const std::string &directory, const DamGeometry &geometry,
               const std::vector<Vector3> &at_start) const;

    /** Returns the largest value at the last recorded time [m]. @p slip: true for slip, false for opening. */
    Extreme residual(bool slip) const;

    /** Largest opening and slip of a joint [m]. */
    struct Residual
    {
      double opening = 0., slip = 0.;
    };

    /** Returns the largest values of each joint at the last recorded time. */
    std::vector<Residual> residuals() const;

    /** Keeps residuals() as those of a part of the ground motion. */
    void end_part();

    /** Returns the kept residuals of a part, or nothing if end_part() was not called so often. */
    std::vector<Residual> residuals_of_part(std::size_t part) const;

    /** Returns true if any joint has a waterstop. */
    bool has_waterstops() const { return !waterstops.empty(); }

    /** Returns the largest height at the top of a joint without waterstop [m], and the number of this joint
     * (counted from 1). The height is 0 if all waterstops reach the top. */
    std::pair<double, unsigned int> height_without_waterstop() const;

    Extreme waterstop_opening; ///< largest opening at the waterstops over time [m]
    Extreme waterstop_slip;    ///< largest slip at the waterstops over time [m]

    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &opening &slip &waterstop_opening &waterstop_slip &last_time &of_parts;
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
    std::vector<double>  of_parts;      ///< opening and slip of each joint, part after part [m]
    double               last_time = 0.;
  };
} // namespace Voussoir

#endif
