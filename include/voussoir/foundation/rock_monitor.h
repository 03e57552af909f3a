// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_monitor_h
#define voussoir_rock_monitor_h

#include <voussoir/foundation/foundation.h>
#include <voussoir/foundation/rock_balance.h>
#include <voussoir/rock/rock_model.h>

namespace Voussoir
{
  /** Monitor of the instability of explicit rock. It monitors the energy that enters through the artificial
   * boundary, the energy error of the coupling with the dam, and velocities and displacements of the nodes.
   * StabilityMonitor describes the bounds. */
  class RockMonitor : public NeighbourMonitor
  {
  public:
    /** Stores the references, which must outlive the object. energy_excess() and motion_excess() require
     * set_bounds().
     *
     * @param parameters parameters of the rock
     * @param model rock model; the stiffness matrix may be empty
     * @param region the rock in time
     * @param balance energies of the rock and of its coupling */
    RockMonitor(const FoundationParameters &parameters, const RockModel &model, ExplicitRegion &region,
                const RockBalance &balance);

    /** Stores the bounds. The bound of the energies is three times the sum of the energy of the incident wave
     * and the static strain energy. */
    void set_bounds(const GroundMotion &motion, const NeighbourBounds &bounds) override;

    /** Gathers the motion of the rock on all ranks if a node of any rank exceeds its bound and the next
     * call of motion_excess() is due. Must be called by all ranks at the end of each time step.
     *
     * @param step number of the time step of the dam, from 1
     * @param n_steps number of time steps of the run */
    void gather_motion(unsigned int step, unsigned int n_steps);

    std::string energy_excess() const override;
    std::string motion_excess() const override;
    std::string suggestions() const override;

  private:
    const FoundationParameters &parameters;
    const RockModel            &model;
    ExplicitRegion             &region;
    const RockBalance          &balance;
    NeighbourBounds             bounds;            ///< of a node; zero before set_bounds()
    double                      energy_bound = 0.; ///< upper bound of the energy supplied to the rock [J]
  };
} // namespace Voussoir

#endif
