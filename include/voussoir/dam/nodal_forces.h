// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_nodal_forces_h
#define voussoir_nodal_forces_h

#include <voussoir/dam/load_parameters.h>
#include <voussoir/solid/solid_model.h>

namespace Voussoir
{
  /** The forces "Loads/Concentrated" on the nodes nearest to their places, in equal parts where several nodes
   * share the place, as at joints [N]. Throws InputError for a place farther from the dam than an element is
   * large, and for one at the held base. */
  void add_concentrated(const SolidModel &model, const LoadParameters &loads, Unknowns &load);

  /** The force per length "Loads/Crest line" along the edge of the crest with the surface "upstream" or
   * "downstream" [N]. Throws InputError where the mesh has no such edge. */
  void add_crest_line(const SolidModel &model, const LoadParameters &loads, Unknowns &load);
} // namespace Voussoir

#endif
