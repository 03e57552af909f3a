// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_base_part_h
#define voussoir_base_part_h

#include <voussoir/base/tensor3.h>
#include <voussoir/solid/solid_model.h>

#include <functional>
#include <map>

namespace Voussoir
{
  /** Part of the surface "base": the faces with their centre in a region. */
  struct BasePart
  {
    std::function<bool(const Vector3 &)> contains; ///< true for a position in the region [m]

    unsigned int n_faces = 0; ///< number of faces in the part
    double       area = 0.;   ///< of these faces [m^2]
    Vector3      centroid{};  ///< of these faces [m]

    /** Area of the part at each node of the model, weighted by the shape functions [m^2]; without zeros. */
    std::map<unsigned int, double> area_of_node;

    /** Share of the force at a node of the model that acts on the part: area at the node in the part, divided by
     * the area at the node of the whole base. Nodes without a face of the base have 1 or 0 by their position [-]. */
    std::vector<double> share;
  };

  /** Returns the part of the base of @p model in a region. @p contains: true for a position in the region [m]. */
  BasePart base_part(const SolidModel &model, const std::function<bool(const Vector3 &)> &contains);
} // namespace Voussoir

#endif
