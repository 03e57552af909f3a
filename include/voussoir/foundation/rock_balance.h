// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_rock_balance_h
#define voussoir_rock_balance_h

#include <voussoir/rock/explicit_region.h>

#include <algorithm>
#include <string>

namespace Voussoir
{
  /** Energy balances of explicit rock and of its coupling with the dam.
   *
   * The work of the rock on the base nodes is computed in the time integration of the dam. The work of the
   * base nodes on the rock is computed in the time integration of the rock. The sum of both works is the
   * energy error of the coupling. */
  class RockBalance
  {
  public:
    /** Starts at zero. @p region: the rock, which must outlive the object. @p is_subcycled: the rock is
     * SubcycledRock, which adds its works to the entries. */
    RockBalance(const ExplicitRegion &region, bool is_subcycled);

    /** Returns the energies of the rock, half a rock time step before ExplicitRegion::time() [J]. With
     * several ranks they are those of the last ExplicitRegion::gather_energy(). */
    RegionEnergy of_rock() const { return region.energy(); }

    /** Returns the work of the rock on the base nodes since the start [J]. */
    double work_on_dam() const { return entries[on_dam]; }

    /** Returns the work of the base nodes on the rock since the start [J]. */
    double work_on_rock() const { return is_subcycled ? entries[on_rock] : of_rock().prescribed; }

    /** Returns the energy error of the coupling since the start [J]. */
    double coupling_error() const { return work_on_rock() + work_on_dam(); }

    /** Updates the largest energy and the largest error of the rock. Must be called at the end of each time
     * step, after ExplicitRegion::gather_energy(). */
    void update_largest();

    /** Returns the largest error of the rock so far, relative to its largest energy so far [-]. */
    double error() const { return entries[largest_error] / std::max(entries[largest_energy], 1e-300); }

    /** Returns the current energies and works [J] with their column names in energy.csv. Work of the base
     * nodes on the rock, in the time integration of the rock: rock_feet. Error of the balance of the rock:
     * rock_balance. coupling_error(): interface. */
    std::vector<std::pair<std::string, double>> columns() const;

    /** Index in the entries. on_dam: work_on_dam(). largest_energy, largest_error: largest absolute values
     * of the rock so far. on_rock: work_on_rock() of SubcycledRock. */
    enum Entry
    {
      on_dam,
      largest_energy,
      largest_error,
      on_rock
    };

    std::vector<double> entries; ///< values by Entry [J]; a vector for Neighbour::state()

  private:
    const ExplicitRegion &region;
    const bool            is_subcycled;
  };
} // namespace Voussoir

#endif
