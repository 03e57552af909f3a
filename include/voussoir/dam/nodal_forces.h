// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_nodal_forces_h
#define voussoir_nodal_forces_h

#include <voussoir/dam/load_parameters.h>
#include <voussoir/solid/solid_model.h>

namespace Voussoir
{
  /** Adds a force to @p load [N]. It acts on the nodes of its element by the shape functions. At a joint the blocks
   * receive equal parts. Throws InputError, which begins with @p what, if the distance to the dam exceeds the element
   * size, or if all these nodes are fixed. */
  void add_point_force(const SolidModel &model, const std::string &what, const PointLoad &point,
                       Unknowns &load);

  /** Adds the forces of "Loads/Concentrated" to @p load [N], as add_point_force(). */
  void add_concentrated(const SolidModel &model, const LoadParameters &loads, Unknowns &load);

  /** Adds the force per length of "Loads/Crest line" to @p load [N]. It acts along the edge of the crest with
   * the surface "upstream" or "downstream". Throws InputError if the mesh has no such edge. */
  void add_crest_line(const SolidModel &model, const LoadParameters &loads, Unknowns &load);
} // namespace Voussoir

#endif
