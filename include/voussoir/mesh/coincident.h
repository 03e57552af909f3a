// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_coincident_h
#define voussoir_coincident_h

#include <array>
#include <memory>
#include <vector>

namespace Voussoir
{
  /** Search tree for the nearest point of a set, in logarithmic time. */
  class PointFinder
  {
  public:
    /// Number of a point that does not exist.
    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    /** Builds the tree. @p tolerance: largest distance of coincident points in find() [m]. */
    explicit PointFinder(const std::vector<std::array<double, 3>> &points, double tolerance = 0.);
    ~PointFinder();

    /** Returns the number of the point nearest to @p place, or none if its distance exceeds the tolerance. */
    unsigned int find(const std::array<double, 3> &place) const;

    struct Nearest
    {
      unsigned int number;   ///< number of the point; none in an empty set
      double       distance; ///< [m]
    };
    /** Returns the point nearest to @p place, at any distance. */
    Nearest nearest(const std::array<double, 3> &place) const;

    /** Returns the numbers of up to eight points whose distance exceeds the least one by at most @p slack [m]. So points at
     * the same distance do not depend on round-off. */
    std::vector<unsigned int> all_nearest(const std::array<double, 3> &place, double slack) const;

  private:
    struct Tree;
    std::unique_ptr<Tree> tree;
    double                tolerance;
  };
} // namespace Voussoir

#endif
