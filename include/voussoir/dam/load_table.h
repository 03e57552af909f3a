// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_load_table_h
#define voussoir_load_table_h

#include <voussoir/dam/scene.h>
#include <voussoir/solid/solid_model.h>

namespace Voussoir
{
  /** One static load of a dam. */
  struct StaticLoad
  {
    std::string name;
    bool        is_raised; ///< in the increments of the water; or there from the first
    Unknowns    force;     ///< on the free nodes [N]
  };

  /** The static loads that a scene asks for, a row of the table each. */
  std::vector<StaticLoad> static_loads(const Scene &scene, const SolidModel &model,
                                       const Structure &structure);
} // namespace Voussoir

#endif
