// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_coincident_h
#define voussoir_coincident_h

#include <array>
#include <memory>
#include <vector>

namespace Voussoir
{
  /** Finds the point of a set that lies at a place: nearest, within a tolerance, in logarithmic time. */
  class PointFinder
  {
  public:
    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    /** @p tolerance: largest distance of two places that are the same [m]. */
    explicit PointFinder(const std::vector<std::array<double, 3>> &points, double tolerance = 0.);
    ~PointFinder();

    /** Number of the point at @p place; none if there is none. */
    unsigned int find(const std::array<double, 3> &place) const;

    struct Nearest
    {
      unsigned int number;   ///< none in an empty set
      double       distance; ///< [m]
    };
    Nearest nearest(const std::array<double, 3> &place) const; ///< however far it is

  private:
    struct Tree;
    std::unique_ptr<Tree> tree;
    double                tolerance;
  };
} // namespace Voussoir

#endif
