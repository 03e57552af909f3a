// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_load_table_h
#define voussoir_load_table_h

#include <voussoir/dam/scene.h>
#include <voussoir/solid/solid_model.h>
#include <voussoir/solid/stress.h>

namespace Voussoir
{
  /** Where static loads act. */
  struct LoadSite
  {
    const SolidModel            &model;
    const Structure             &structure;
    const std::vector<Material> &materials;
  };

  /** One static load of a dam. */
  struct StaticLoad
  {
    std::string         name;
    bool                is_raised; ///< in the increments of the water; or there from the first
    double              factor;    ///< of the combination, in force and stress [-]
    Unknowns            force;     ///< on the free nodes [N]
    std::vector<Stress> stress;    ///< that comes to the recovered one, per node of the model [Pa]; or empty

    Vector3 resultant() const; ///< [N]
  };

  /** The static loads that a scene asks for, a row of the table each, with the factors of its combination. */
  std::vector<StaticLoad> static_loads(const Scene &scene, const LoadSite &site);
} // namespace Voussoir

#endif
