// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_water_h
#define voussoir_joint_water_h

#include <voussoir/contact/joint_law.h>
#include <voussoir/solid/solid_model.h>

#include <functional>

namespace Voussoir
{
  class Dam;

  /** Water pressure in joints. Water enters an open pair from the upstream face, or from a pair under
   * water pressure on the same element face. It does not leave the pair again. Below the closed part of a base joint
   * there is no pressure, or a linear one. */
  class JointWater
  {
  public:
    /** Finds the neighbours of all pairs. No pair is under water pressure. */
    JointWater(const SolidModel &model, const Structure &structure);

    /** Applies a linear pressure below closed parts: from the next pair under water pressure or on the upstream face
     * of the same joint to @p toe at the downstream face.
     * @param given position of each pair in the thickness, 0 upstream to 1 downstream; negative: no pressure
     * @param toe pressure at the height z at the downstream face [Pa] */
    void seep(std::vector<double> given, std::function<double(double)> toe)
    {
      place = std::move(given);
      at_toe = std::move(toe);
    }

    /** Returns the pairs that pass water and are connected to the upstream face, or to pairs under water pressure, by
     * pairs that pass water. @p passes: for each pair. */
    std::vector<bool> reached(const std::vector<bool> &passes) const;

    /** Lets water into all open pairs that it can reach, if the pressure is positive. Returns true if there
     * are new pairs under water pressure. @p pressure: pressure at the height z [Pa]. */
    bool spread(const std::vector<PairState> &states, const std::function<double(double)> &pressure);

    /** Adds the forces of the water on both sides of the pairs, pressure times area, to @p load [N]. */
    void add_forces(const std::function<double(double)> &pressure, Unknowns &load) const;

    /** Returns the pressure in each pair [Pa]. */
    std::vector<double> pressures(const std::function<double(double)> &pressure) const;

    /** Returns the number of pairs under water pressure. */
    unsigned int n_wet() const;

  private:
    const Structure                       &structure;
    std::vector<bool>                      at_upstream; ///< true: pair on the upstream face
    std::vector<std::vector<unsigned int>> neighbours;  ///< of each pair
    std::vector<bool>                      wet;         ///< true: pair under water pressure
    std::vector<double>                    place;       ///< of seep(), or empty
    std::function<double(double)>          at_toe;

    double below_closed_part(unsigned int p, const std::function<double(double)> &pressure) const;
  };

  /** Returns the water in the joints before any static load, by the rules of the scene. */
  JointWater joint_water(const Dam &dam);
} // namespace Voussoir

#endif
