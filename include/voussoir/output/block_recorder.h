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
    /** @p joint_water: water pressure in each pair [Pa], or empty. */
    BlockRecorder(Dam &dam, const std::vector<double> &joint_water);

    /** Computes the forces at the end of a step of the dam, or of the static state. */
    void follow(const StepOfDam &step);

    /** Adds the forces of the last follow() to the history and to the extremes. @p time: time [s]. */
    void record(double time);

    Table history; ///< rows of blocks.csv

    /** Returns true if the scene has a strength of the base, which the safety against sliding requires. */
    bool has_safety() const { return friction > 0. || cohesion > 0.; }

    /** Returns the smallest safety against sliding [-] of all monoliths, at the centroid of a base. */
    Extreme least_safety() const;

    /** Returns base and extremes of each monolith: "blocks" of summary.json. */
    Json json() const;

    template <class Archive> void serialize(Archive &archive, unsigned int) { archive &history &extremes; }

  private:
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
    std::vector<Wrench>   now;      ///< per base
    std::vector<Extremes> extremes; ///< per base
  };
} // namespace Voussoir

#endif
