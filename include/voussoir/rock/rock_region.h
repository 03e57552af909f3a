// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_region_h
#define voussoir_rock_region_h

#include <voussoir/rock/explicit_region.h>
#include <voussoir/rock/free_field.h>

namespace Voussoir
{
  /** The boundary that the parameters choose, not yet attached. */
  std::unique_ptr<ArtificialBoundary> make_boundary(const RockRegionParameters &parameters);

  /** The region of a model with its artificial boundary. @p split: if several ranks are to step it. */
  std::unique_ptr<ExplicitRegion> make_region(const RockModel &model, const RockRegionParameters &parameters,
                                              RockSplit split = RockSplit());

  /** A check of stability: kinetic energy of the region after @p n_steps from random motion, relative to that
   * after a tenth of them. Stable regions lose energy: below 1. @p fixed: components that do not move, 3 node
   * + component. */
  double noise_growth(const RockModel &model, const RockRegionParameters &parameters,
                      unsigned int n_steps = 2000, const std::vector<unsigned int> &fixed = {});

  /** Those of the sections of the free field: as the region's, but what a boundary that does not absorb would
   * throw back must leave them; they have the default boundary then. */
  RockRegionParameters of_sections(const RockRegionParameters &parameters);

  /** The motion without dam, as yet without points; @p split: of the region. InputError for an unknown kind
   * of free field. */
  std::unique_ptr<FreeField> make_free_field(const RockModel &model, const RockRegionParameters &parameters,
                                             const IncidentWave &wave, unsigned int n_steps,
                                             const RockSplit &split = RockSplit());

  /** Lets the earthquake in. @p n_steps: as many as will be made at most. */
  void shake(ExplicitRegion &region, const RockModel &model, const RockRegionParameters &parameters,
             const IncidentWave &wave, unsigned int n_steps);
} // namespace Voussoir

#endif
