// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_boundary_lines_h
#define voussoir_boundary_lines_h

#include <voussoir/mesh/mesh.h>

#include <string>
#include <vector>

namespace Voussoir
{
  /** The planes that cut the rock out of the ground: x smallest and largest, y smallest and largest, and z
   *  smallest. */
  enum class CutFace
  {
    upstream,
    downstream,
    right,
    left,
    bottom
  };

  /** "upstream", "downstream", "right bank", "left bank", "bottom" */
  std::string name_of(CutFace face);

  /** Coordinate that is constant on the face: 0, 1 or 2. */
  unsigned int normal_axis(CutFace face);

  /** A straight grid line from a node of the artificial boundary into the rock, normal to one face, with
   * equal spacing: what a transmitting boundary extrapolates along. */
  struct GridLine
  {
    CutFace                   face;
    double                    spacing; ///< [m]
    int                       volume;  ///< the rock it runs in; the smaller id if between two
    std::vector<unsigned int> nodes;   ///< n_layers + 1 of them, from the boundary inward
  };

  /** The line of every node of surface PhysicalId::artificial, ordered by that node. A node on several faces
   *  has the line normal to upstream or downstream if it lies there, else to the right or left bank, else to
   *  the bottom; so the line of a bottom edge runs along the bottom, and that of a ground edge along the
   *  ground.
   *
   *  The mesh must have passed check_mesh(), and @p n_layers be at least 1. Throws InputError, beginning with
   * @p source (the file), if a face is not plane, not normal to an axis or not outermost, or a line leaves
   * the rock within @p n_layers elements, is bent, not normal to the face, of unequal spacing, or changes the
   * material. Deviations up to 1e-5 of the spacing are allowed. */
  std::vector<GridLine> boundary_lines(const HexMesh &mesh, unsigned int n_layers, const std::string &source);
} // namespace Voussoir

#endif
