// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_zone_forces_h
#define voussoir_zone_forces_h

#include <voussoir/rock/explicit_region.h>
#include <voussoir/rock/free_field.h>
#include <voussoir/rock/section_motion.h>
#include <voussoir/rock/sections.h>

namespace Voussoir
{
  /** Forces of the free field on a section with a zone (widened()). The nodes of the section have the total motion u, the
   * nodes of the zone the scattered motion u - u_0. The forces act where both meet: with the stiffness K of the
   * cells of the zone they are -K_be u_0e at the nodes b of the section and K_eb u_0b at the nodes e of the zone
   * (domain reduction method, Bielak and Christiano 1984, Earthq. Eng. Struct. Dyn. 12, 107-119). Waves that the
   * section scatters thus leave through the zone, and the free field does not cross the zone. */
  class ZoneForces
  {
  public:
    /** Creates the forces.
     * @param wide section with a zone; @p model: its model
     * @param section model of the section alone, whose columns give the free field
     * @param direction of the section (0: x, 1: y)
     * The other arguments are those of make_free_field(). */
    ZoneForces(const WideSection &wide, const RockModel &model, const RockModel &section,
               unsigned int direction, const RockRegionParameters &parameters, const IncidentWave &wave,
               unsigned int n_steps);

    /** Advances the free field by one step; see IncidentField::begin_step(). */
    void begin_step(std::vector<Ranks::Message> &messages) { field.begin_step(messages); }
    /** Completes the step of begin_step() and stores the forces in @p force, three values per node of the model [N]. */
    void end_step(Unknowns &force);

    std::vector<std::vector<double> *> state();

  private:
    FreeField                     field; ///< its points are the nodes of the strip
    double                        dt, stiffness_damping;
    std::vector<unsigned int>     node;      ///< node of the model per node of the strip
    std::vector<bool>             is_inside; ///< per node of the strip: whether it belongs to the section
    std::size_t                   n_nodes;   ///< of the model
    std::vector<double>           before;    ///< displacement of the free field in the previous step [m]
    std::unique_ptr<RockOperator> strip;     ///< stiffness of the cells of the zone at the section
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
