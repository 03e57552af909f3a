// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_face_distance_h
#define voussoir_face_distance_h

#include <voussoir/solid/solid_model.h>

namespace Voussoir
{
  /** Returns the relative position of each node of the model in the thickness, from 0 upstream to 1
   * downstream. It is the distance to the surface "upstream" divided by the sum of the distances to
   * "upstream" and "downstream". Each element face is approximated by four triangles.
   * @p at_base: true: position of the nodes at the base, 0 for others, from the distances to the heel and to the toe, the
   * lower edges of these surfaces. Below a sloped face the toe is farther away than the face.
   *
   * Throws InputError, with the @p entry, if the mesh lacks one of the surfaces. */
  std::vector<double> places_in_thickness(const SolidModel &model, const std::string &entry, bool at_base);
} // namespace Voussoir

#endif
