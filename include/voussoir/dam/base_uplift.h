// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_base_uplift_h
#define voussoir_base_uplift_h

#include <voussoir/dam/scene.h>
#include <voussoir/solid/solid_model.h>

#include <map>
#include <set>

namespace Voussoir
{
  /** Returns the head of the water under the base [m], or its pressure [Pa]. It is linear from heel to toe.
   * With drains at d it is linear in two parts, with the value toe + (1 - efficiency) (1 - d) (heel - toe) at
   * the drains (U.S. Army Corps of Engineers, EM 1110-2-2200, section 3-3, drains at the level of the tail
   * water).
   *
   * @param s position in the thickness, 0 upstream, 1 downstream [-]
   * @param heel value at the upstream end
   * @param toe value at the downstream end
   * @param uplift position d and efficiency of the drains */
  double uplift_head(double s, double heel, double toe, const UpliftParameters &uplift);

  /** Uplift on the surface "base": the part of the base compression that is water pressure. */
  struct BaseUplift
  {
    Unknowns               force;       ///< three values per node of the model, including fixed nodes [N]
    std::map<int, Vector3> of_monolith; ///< resultant of each monolith, by number [N]
  };

  /** Returns the uplift by uplift_head(), with the factors of the load combination. @p closed: surfaces above footings
   * whose base joints are tied. On rock with footings, only the other base joints have forces. */
  BaseUplift base_uplift(const Scene &scene, const SolidModel &model, const std::set<int> &closed = {});
} // namespace Voussoir

#endif
