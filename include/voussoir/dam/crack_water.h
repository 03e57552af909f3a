// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_crack_water_h
#define voussoir_crack_water_h

#include <voussoir/dam/dam.h>
#include <voussoir/dam/joint_water.h>
#include <voussoir/dam/static_state.h>

namespace Voussoir
{
  /** Water pressure in joints during the earthquake, by the rule "Loads/Uplift/In earthquake". The pressures of a step
   * follow from the openings at the end of the previous step. */
  class CrackWater : public Neighbour
  {
  public:
    /** Begins with the pressures of the static state. @p dam, @p statics: must outlive the object. */
    CrackWater(const Dam &dam, const StaticState &statics);

    void                               advance(Unknowns &load) override;
    void                               update_from_dam(const DynamicState &state) override;
    std::vector<std::vector<double> *> state() override { return {&change, &of_step}; }

    /** Returns the change of the pressure in each pair from the static state to the last step [Pa]. */
    const std::vector<double> &acting() const { return of_step; }

  private:
    double full(std::size_t pair) const;

    const Dam          &dam;
    const StaticState  &statics;
    JointWater          water;
    std::vector<double> at_rest; ///< pressure in each pair in the static state [Pa]
    std::vector<double> change,
        of_step; ///< of the pressure in each pair: in the next and in the last step [Pa]
  };
} // namespace Voussoir

#endif
