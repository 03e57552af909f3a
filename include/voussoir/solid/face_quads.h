// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_face_quads_h
#define voussoir_face_quads_h

#include <voussoir/solid/solid_model.h>

namespace Voussoir
{
  /** Quadrilateral between four neighbouring nodes of a surface. It is a face of a cell, or a part of it if
   * the cell has nodes inside its edges. */
  struct FaceQuad
  {
    std::array<unsigned int, 4> nodes;        ///< in order around the quadrilateral
    unsigned int                block;        ///< physical id of the volume, see monolith_of()
    bool                        is_clockwise; ///< order of the nodes, seen from outside of the cell
  };

  /** Returns the quadrilaterals of a surface, cell after cell.
   * @param model mesh of the bodies
   * @param surface boundary id, such as PhysicalId::upstream or a side of a joint */
  std::vector<FaceQuad> face_quads(const SolidModel &model, int surface);

  /** Returns the quadrilaterals of side 1 of a joint, or of side 2 if side 1 is the ground. @p joint: its index. */
  std::vector<FaceQuad> quads_of_joint(const SolidModel &model, unsigned int joint);

  /** Returns the area of the quadrilateral [m^2]. */
  double area(const SolidModel &model, const FaceQuad &quad);
} // namespace Voussoir

#endif
