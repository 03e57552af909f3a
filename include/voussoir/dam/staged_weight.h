// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_staged_weight_h
#define voussoir_staged_weight_h

#include <voussoir/dam/dam_geometry.h>
#include <voussoir/dam/scene.h>
#include <voussoir/solid/stress.h>

namespace Voussoir
{
  /** Free-standing monoliths under their weight. */
  struct StagedWeight
  {
    /** Displacement of the crown, x, y, z [m]. It precedes grouting and is not included in other displacements. */
    Vector3 crown = {{0., 0., 0.}};

    /** Force on each node of the model, three values per node: of the foundation, and of the other block at lift joints;
     * zero elsewhere. Empty without staged self-weight [N]. */
    Unknowns reaction;
  };

  /** Computes the state of free-standing monoliths, whose lifts are tied, under their weight.
   * @param sustained materials of the static state
   * @param stress stress of this state is added, one value per node of the model [Pa] */
  StagedWeight staged_weight(const Scene &scene, const std::vector<Material> &sustained,
                             const SolidModel &model, const Structure &structure, const DamGeometry &geometry,
                             const std::vector<Joint> &joints, std::vector<Stress> &stress);
} // namespace Voussoir

#endif
