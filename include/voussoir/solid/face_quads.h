// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_face_quads_h
#define voussoir_face_quads_h

#include <voussoir/solid/solid_model.h>

namespace Voussoir
{
  /** A quadrilateral between four neighbouring nodes of a surface: a face of a cell, or a part of it where
   * the cell has nodes inside its edges. */
  struct FaceQuad
  {
    std::array<unsigned int, 4> nodes; ///< around it
    unsigned int                monolith;
  };

  /** Those of a surface of the bodies, such as PhysicalId::upstream or a side of a joint, cell after cell. */
  std::vector<FaceQuad> face_quads(const SolidModel &model, int surface);

  /** Area of the quadrilateral [m^2]. */
  double area(const SolidModel &model, const FaceQuad &quad);
} // namespace Voussoir

#endif
