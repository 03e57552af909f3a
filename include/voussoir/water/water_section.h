// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_water_section_h
#define voussoir_water_section_h

#include <voussoir/base/tensor3.h>

#include <array>
#include <vector>

namespace Voussoir
{
  using Point2 = std::array<double, 2>; ///< y, z [m]

  /** Quadrilateral of the wet face, as seen along the river. */
  struct WetQuad
  {
    std::array<Vector3, 4> corners;  ///< in order around the quadrilateral [m]
    int                    monolith; ///< number of its monolith
  };

  /** Mesh of the cross section of the reservoir, the projection of the wet face of the dam to the y-z plane below the
   * water level.
   *
   * Squares hang from the water line. One row of quadrilaterals joins their staircase to the bank. A Laplace
   * smoothing follows, in which nodes of the bank move along it and nodes of the water line move in y. */
  struct WaterSection
  {
    std::vector<Point2>                      points; ///< nodes [m]
    std::vector<std::array<unsigned int, 4>> cells;  ///< nodes, counter-clockwise in the y-z plane
    std::vector<unsigned int>                bank;   ///< chain of nodes from the right end of the water line
    std::vector<bool>                        at_surface; ///< per node: on the water line
    std::vector<double>                      face_x;     ///< per node: x of the wet face [m]
    std::vector<int>
        monolith; ///< per node: monolith of the wet face; on a joint the one nearer to the middle of the water line

    /** @param faces upstream face of the dam, above and below the water level
     * @param level water level [m]
     * @param h size of the squares [m]
     * @param is_slice true: one column of quadrilaterals of the height h, whose bank is the bed only
     *
     * Throws InputError if the face is folded as seen along the river, or if the water level is not on the face;
     * CoarseWater if the section cannot be meshed with this size. */
    WaterSection(const std::vector<WetQuad> &faces, double level, double h, bool is_slice = false);
  };
} // namespace Voussoir

#endif
