// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_water_h
#define voussoir_joint_water_h

#include <voussoir/contact/joint_law.h>
#include <voussoir/solid/solid_model.h>

#include <functional>

namespace Voussoir
{
  /** Water in the joints: it enters an open pair from the upstream face, or from a neighbour in the joint
   * that is wet (in the same face of an element), and stays. */
  class JointWater
  {
  public:
    JointWater(const SolidModel &model, const Structure &structure);

    /** Lets the water into all pairs that it reaches, where the pressure is above zero; were there any new
     * ones? @p pressure: at a height z [Pa]. */
    bool spread(const std::vector<PairState> &states, const std::function<double(double)> &pressure);

    /** The forces on both sides of the wet pairs, pressure times area, that press them apart [N]. */
    void add_forces(const std::function<double(double)> &pressure, Unknowns &load) const;

    /** In each pair [Pa]. */
    std::vector<double> pressures(const std::function<double(double)> &pressure) const;

    unsigned int n_wet() const;

  private:
    const Structure                       &structure;
    std::vector<bool>                      at_upstream; ///< pairs on the upstream face
    std::vector<std::vector<unsigned int>> neighbours;  ///< of each pair
    std::vector<bool>                      wet;
  };
} // namespace Voussoir

#endif
