// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_block_recorder_h
#define voussoir_block_recorder_h

#include <voussoir/base/log.h>
#include <voussoir/dam/base_force.h>
#include <voussoir/output/recorders.h>

namespace Voussoir
{
  /** Forces of the foundation on the bases of the monoliths over time, and the safety against sliding. */
  class BlockRecorder
  {
  public:
    /** Prepares the records.
     * @param dam dam in the static state
     * @param joint_water water pressure in each pair [Pa]; empty: none */
    BlockRecorder(Dam &dam, const std::vector<double> &joint_water);

    /** Computes the forces on the bases.
     * @param step end of a step of the dam, or the static state
     * @param water change of the water pressure in each pair from the static state [Pa], or empty */
    void follow(const StepOfDam &step, const std::vector<double> &water = {});

    /** Adds the forces of the last follow() to history and extremes. @p time: present time [s]. */
    void record(double time);

    Table history; ///< forces over time: rows of blocks.csv

    /** Returns true if the input file has a strength of the base (Limits/Base friction or cohesion), which the
     * safety against sliding requires. */
    bool has_safety() const { return friction > 0. || cohesion > 0.; }

    /** Returns the smallest safety against sliding over time of all monoliths [-]. Its position is the centroid
     * of the base of the monolith. */
    Extreme least_safety() const;

    /** Returns the smallest safety against sliding of all monoliths in the last follow() [-], and the number of
     * the monolith. */
    std::pair<double, int> last_safety() const;

    /** Returns area and extremes of the base of each monolith: "blocks" of summary.json. */
    Json json() const;

    template <class Archive> void serialize(Archive &archive, unsigned int) { archive &history &extremes; }

  private:
    double safety_of(std::size_t b) const;

    struct Extremes ///< over time, of one monolith
    {
      Extreme                       compression, least_compression, shear, safety;
      template <class Archive> void serialize(Archive &archive, unsigned int)
      {
        archive &compression &least_compression &shear &safety;
      }
    };
    const double          friction, cohesion; ///< of the base [-], [Pa]
    const BaseForces      forces;
    std::vector<double>   more; ///< uplift in the last step without that of the static state, per base [N]
    std::vector<Wrench>   now;  ///< per base
    std::vector<Extremes> extremes; ///< per base
  };
} // namespace Voussoir

#endif
