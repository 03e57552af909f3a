#ifndef voussoir_rock_region_h
#define voussoir_rock_region_h

#include <voussoir/rock/explicit_region.h>
#include <voussoir/rock/free_field.h>

namespace Voussoir
{
  /** What a scene says of the rock. */
  struct RockRegionParameters
  {
    RockParameters  rock;
    RayleighDamping damping;
    double          dt = .001;         ///< [s]
    std::string     boundary = "mtf3"; ///< mtf1..mtf4, mtf2-plain, viscous-spring, viscous, fixed

    /** Motion without dam: "columns" (layers, with the ground's local height at the side faces), or
     * "sections" (slices of the mesh where the upstream and downstream faces cut the valley). */
    std::string free_field = "sections";
  };

  /** The region of a model with its artificial boundary. @p formula: instead of the boundary's name. */
  std::unique_ptr<ExplicitRegion> make_region(const RockModel &model, const RockRegionParameters &parameters,
                                              const TransmittingFormula *formula = nullptr);

  /** Why a transmitting boundary may be unstable with these parameters, for the user; empty if it should not:
   * Gauss points near it (for orders 3 and 4 anywhere: a large box explodes), or no term against drift,
   * without the damping that suppresses it. */
  std::string stability_warning(const RockRegionParameters &parameters,
                                const TransmittingFormula  *formula = nullptr);

  /** The check itself: kinetic energy of the region after @p n_steps from random motion, relative to that
   * after a tenth of them. Stable regions lose energy: below 1. */
  double noise_growth(const RockModel &model, const RockRegionParameters &parameters,
                      unsigned int n_steps = 2000, const TransmittingFormula *formula = nullptr);

  /** The motion without dam, as yet without points. */
  std::unique_ptr<FreeField> make_free_field(const HexMesh &mesh, const RockModel &model,
                                             const RockRegionParameters &parameters, const IncidentWave &wave,
                                             unsigned int               n_steps,
                                             const TransmittingFormula *formula = nullptr);

  /** Lets the earthquake in. @p mesh: that of the model; @p n_steps: as many as will be made at most. */
  void shake(ExplicitRegion &region, const HexMesh &mesh, const RockModel &model,
             const RockRegionParameters &parameters, const IncidentWave &wave, unsigned int n_steps,
             const TransmittingFormula *formula = nullptr);
} // namespace Voussoir

#endif
