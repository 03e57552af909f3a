// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_boundary_lines_h
#define voussoir_boundary_lines_h

#include <voussoir/mesh/mesh.h>

#include <string>
#include <vector>

namespace Voussoir
{
  /** Planes of the artificial boundary: smallest and largest x, smallest and largest y, and smallest z. */
  enum class CutFace
  {
    upstream,
    downstream,
    right,
    left,
    bottom
  };

  /** Returns "upstream", "downstream", "right bank", "left bank" or "bottom". */
  std::string name_of(CutFace face);

  /** Returns the coordinate that is constant on the face: 0, 1 or 2. */
  unsigned int normal_axis(CutFace face);

  /** Straight grid line from a node of the artificial boundary into the rock, normal to one face, with equal
   * spacing. A transmitting boundary extrapolates along such lines. */
  struct GridLine
  {
    CutFace                   face;
    double                    spacing; ///< [m]
    int                       volume;  ///< id of the rock volume; between two volumes the smaller id
    std::vector<unsigned int> nodes;   ///< n_layers + 1 nodes, from the boundary inward
  };

  /** Returns the grid lines of all nodes of the surface PhysicalId::artificial, ordered by these nodes.
   *
   * A node on several faces has one line, normal to the first of these faces in the order of CutFace. The
   * line from an edge of the bottom therefore runs along the bottom. The line from an edge of the ground runs
   * along the ground.
   *
   * @param mesh must have passed check_mesh()
   * @param n_layers number of elements along each line, at least 1
   * @param source name of the file, for messages
   *
   * Throws InputError if a face does not lie in one of the five planes. Throws InputError if a line has fewer
   * than @p n_layers elements, is not straight and normal to the face, has unequal spacing, or changes the
   * material. Deviations up to 1e-5 of the spacing are allowed. */
  std::vector<GridLine> boundary_lines(const HexMesh &mesh, unsigned int n_layers, const std::string &source);
} // namespace Voussoir

#endif
