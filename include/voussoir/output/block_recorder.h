// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_block_recorder_h
#define voussoir_block_recorder_h

#include <voussoir/base/log.h>
#include <voussoir/dam/base_force.h>
#include <voussoir/output/recorders.h>

namespace Voussoir
{
  /** The forces of the foundation on the bases of the monoliths over time, and their safety against sliding.
   */
  class BlockRecorder
  {
  public:
    BlockRecorder(Dam &dam, const std::vector<double> &joint_water);

    void follow(const StepOfDam &step); ///< the dam has made a step, or rests
    void record(double time);

    Table history; ///< blocks.csv
    bool  has_safety() const { return friction > 0. || cohesion > 0.; }

    Extreme least_safety() const; ///< of all monoliths; its place is the base's centroid
    Json    json() const;         ///< by monolith: its base and its extremes

    template <class Archive> void serialize(Archive &archive, unsigned int) { archive &history &extremes; }

  private:
    struct Extremes ///< over time
    {
      Extreme                       compression, least_compression, shear, safety;
      template <class Archive> void serialize(Archive &archive, unsigned int)
      {
        archive &compression &least_compression &shear &safety;
      }
    };
    const double          friction, cohesion;
    const BaseForces      forces;
    std::vector<Wrench>   now;
    std::vector<Extremes> extremes; ///< per base
  };
} // namespace Voussoir

#endif
