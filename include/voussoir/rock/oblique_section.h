// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_oblique_section_h
#define voussoir_oblique_section_h

#include <voussoir/rock/artificial_boundary.h>
#include <voussoir/rock/section_motion.h>
#include <voussoir/rock/slowness_coupling.h>
#include <voussoir/rock/zone_strip.h>

namespace Voussoir
{
  /** Motion of a section under waves with a slowness p along the valley (x): U(y, z, t - p x), with the
   * equations of SlownessCoupling. u_x lives at half steps and u_y, u_z at whole steps, so the scheme is
   * explicit. The section has a zone that carries the scattered motion only. It is ahead of the region and
   * keeps the motion of the last steps, from which displacement() interpolates. Every process integrates
   * the whole section. */
  class ObliqueSection : public SectionMotion
  {
  public:
    /** Creates the motion at rest.
     * @param wide section with a zone; @p model: its model
     * @param strip strip of the zone at the section, with the waves
     * @param boundary transmitting boundary of the section, not attached
     * @param parameters of the section; the waves have the slowness @p p [s/m], which check_incidence_along() accepts
     * @param reach smallest and largest x of displacement() [m] */
    ObliqueSection(const WideSection &wide, RockModel model, std::unique_ptr<ZoneStrip> strip,
                   std::unique_ptr<ArtificialBoundary> boundary, const RockRegionParameters &parameters,
                   double p, const std::array<double, 2> &reach);

    void    begin_step(std::vector<Ranks::Message> &) override {}
    void    end_step() override;
    Vector3 displacement(unsigned int node, double x) const override;

    std::vector<std::vector<double> *> state() override;

    /** Returns the stiffness damping that the transmitting formula requires in the section, relative to the
     * time step. It follows from Poisson's ratio of the apparent wave speeds (doc/boundary.md). */
    static double least_damping(const std::map<int, Material> &materials, double p);

    /** Returns the number of steps that the section is ahead, for a slowness p and a step dt. */
    static unsigned int steps_ahead(double p, double origin, const std::array<double, 2> &reach, double dt);

  private:
    double largest_frequency() const;
    void   set_forces_of_zone(double later, double step);
    void   substep(double later);

    double       p, origin, dt; ///< slowness [s/m], x without delay [m], time step of the rock [s]
    RockDamping  damping;
    unsigned int n_substeps = 1, lead, n_kept;
    std::unique_ptr<ZoneStrip>          strip;
    RockOperator                        stiffness;
    SlownessCoupling                    coupling, coupling_of_strip;
    std::vector<double>                 mass, mass_along, mass_across; ///< per node [kg]
    std::vector<bool>                   is_explicit;                   ///< per node: not on the boundary
    std::unique_ptr<ArtificialBoundary> boundary;
    Unknowns u, w; ///< displacement, and velocity half a step later; x components half a step earlier
    Unknowns x, K_x, force;            ///< of a step
    Unknowns field_before, field_half; ///< free field of the strip a substep, and half a substep before [m]
    std::vector<double> clock = {0.};  ///< number of steps
    std::vector<double> ring;          ///< displacements of the last steps [m]
  };
} // namespace Voussoir

#endif
