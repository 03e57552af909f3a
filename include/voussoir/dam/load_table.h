// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_load_table_h
#define voussoir_load_table_h

#include <voussoir/dam/scene.h>
#include <voussoir/solid/solid_model.h>
#include <voussoir/solid/stress.h>

namespace Voussoir
{
  /** Model on which static loads act. */
  struct LoadSite
  {
    const SolidModel            &model;
    const Structure             &structure;
    const std::vector<Material> &materials; ///< of the concrete, by zone
  };

  /** One static load of a dam. */
  struct StaticLoad
  {
    std::string         name;
    bool                is_raised; ///< true: applied in the water increments; false: constant
    double              factor;    ///< of the load combination, included in force and stress [-]
    Unknowns            force;     ///< three values per free node [N]
    std::vector<Stress> stress;    ///< initial stress per node of the model [Pa], or empty

    /** Returns the sum of all forces [N]. */
    Vector3 resultant() const;
  };

  /** Returns the active static loads of an input file, with the factors of its load combination. */
  std::vector<StaticLoad> static_loads(const Scene &scene, const LoadSite &site);
} // namespace Voussoir

#endif
