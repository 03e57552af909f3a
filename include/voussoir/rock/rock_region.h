// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_region_h
#define voussoir_rock_region_h

#include <voussoir/rock/explicit_region.h>
#include <voussoir/rock/free_field.h>

namespace Voussoir
{
  /** Creates the artificial boundary that the parameters select. It is not attached. */
  std::unique_ptr<ArtificialBoundary> make_boundary(const RockRegionParameters &parameters);

  /** Creates the region of a model with its artificial boundary. @p split: non-trivial if several MPI
   * processes share the region. */
  std::unique_ptr<ExplicitRegion> make_region(const RockModel &model, const RockRegionParameters &parameters,
                                              RockSplit split = RockSplit());

  /** Returns the parameters of the sections of the free field. They equal those of the region, except for a
   * reflecting boundary. It is replaced by the default boundary, because scattered waves must
   * leave the sections. */
  RockRegionParameters of_sections(const RockRegionParameters &parameters);

  /** Throws InputError if an incident wave does not propagate in the rock, or if the rock has a quality factor and a
   * bottom at different heights, to which the wave would rise without damping. */
  void check_waves(const RockModel &model, const RockRegionParameters &parameters);

  /** Creates the free field, without points. @p split: distribution of the region. Throws InputError for an
   * unknown type of free field. */
  std::unique_ptr<FreeField> make_free_field(const RockModel &model, const RockRegionParameters &parameters,
                                             const IncidentWave &wave, unsigned int n_steps,
                                             const RockSplit &split = RockSplit());

  /** Sets the free field of @p region for the incident @p wave. @p n_steps: largest number of steps
   * of the run. */
  void shake(ExplicitRegion &region, const RockModel &model, const RockRegionParameters &parameters,
             const IncidentWave &wave, unsigned int n_steps);
} // namespace Voussoir

#endif
