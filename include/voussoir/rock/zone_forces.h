// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_zone_forces_h
#define voussoir_zone_forces_h

#include <voussoir/rock/explicit_region.h>
#include <voussoir/rock/section_motion.h>
#include <voussoir/rock/zone_strip.h>

namespace Voussoir
{
  /** Forces of the free field on a section with a zone (widened()). The nodes of the section have the total
   * motion u, the nodes of the zone the scattered motion u - u_0. The forces act where both meet: with the
   * stiffness K of the cells of the zone they are -K_be u_0e at the nodes b of the section and K_eb u_0b at
   * the nodes e of the zone (domain reduction method, Bielak and Christiano 1984, Earthq. Eng. Struct. Dyn.
   * 12, 107-119). Waves that the section scatters thus leave through the zone, and the free field does not
   * cross the zone. */
  class ZoneForces
  {
  public:
    explicit ZoneForces(std::unique_ptr<ZoneStrip> strip, const RockRegionParameters &parameters);

    /** Advances the free field by one step; see IncidentField::begin_step(). */
    void begin_step(std::vector<Ranks::Message> &messages) { strip->field.begin_step(messages); }
    /** Completes the step of begin_step() and stores the forces in @p force, three values per node of the
     * model [N]. */
    void end_step(Unknowns &force);

    std::vector<std::vector<double> *> state();

  private:
    std::unique_ptr<ZoneStrip> strip;
    double                     dt;
    std::vector<double>        before; ///< displacement of the free field in the previous step [m]
    DampedMotion               damped; ///< of the free field
  };

  /** Motion of a section under waves without a slowness along the valley: an explicit region with a zone. */
  class StraightSection : public SectionMotion
  {
  public:
    StraightSection(std::unique_ptr<ExplicitRegion> region, std::unique_ptr<ZoneForces> forces);

    void    begin_step(std::vector<Ranks::Message> &messages) override;
    void    end_step() override;
    Vector3 displacement(unsigned int node, double x) const override;

    std::vector<std::vector<double> *> state() override;
    void                               gather_on_root() override { region->gather_on_root(); }

  private:
    std::unique_ptr<ExplicitRegion> region;
    std::unique_ptr<ZoneForces>     forces;
  };
} // namespace Voussoir

#endif
