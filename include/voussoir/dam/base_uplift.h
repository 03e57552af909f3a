// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_base_uplift_h
#define voussoir_base_uplift_h

#include <voussoir/dam/scene.h>
#include <voussoir/solid/solid_model.h>

#include <map>

namespace Voussoir
{
  /** Head of the water under the base [m] at the place @p s of the thickness from upstream, @p heel and @p
   * toe those at its ends: linear, with drains at the position d linear in two parts, lowered there to toe +
   * (1 - efficiency) (1 - d) (heel - toe) (U.S. Army Corps of Engineers, EM 1110-2-2200, section 3-3, with
   * the drains' outlet at the level of the tail water). */
  double uplift_head(double s, double heel, double toe, const UpliftParameters &uplift);

  /** Uplift on the surface "base": the part of its compression that the water carries. */
  struct BaseUplift
  {
    Unknowns               force; ///< on all nodes of the model, also those that are held: 3 per node [N]
    std::map<int, Vector3> of_monolith; ///< resultants by number [N]
  };

  /** By uplift_head(), with the factors of the combination. */
  BaseUplift base_uplift(const Scene &scene, const SolidModel &model);
} // namespace Voussoir

#endif
