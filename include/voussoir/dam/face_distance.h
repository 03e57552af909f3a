// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_face_distance_h
#define voussoir_face_distance_h

#include <voussoir/solid/solid_model.h>

namespace Voussoir
{
  /** Place of each node of the model through the thickness: its distance to the surface "upstream" over the
   * sum of those to "upstream" and "downstream", 0 upstream, 1 downstream. The faces of the cells are taken
   * as four triangles around their middle. Throws InputError, naming @p entry, where the mesh lacks one of
   * the surfaces. */
  std::vector<double> places_in_thickness(const SolidModel &model, const std::string &entry);
} // namespace Voussoir

#endif
