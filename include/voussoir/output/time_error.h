// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_time_error_h
#define voussoir_time_error_h

#include <voussoir/dam/dam.h>
#include <voussoir/dam/tractions.h>
#include <voussoir/output/face_tension.h>

#include <limits>
#include <optional>

namespace Voussoir
{
  /** What the time step does to the extremes of a run, by estimate. */
  struct TimeError
  {
    /** Of the joints' largest openings at the crest, upstream and downstream: root of the sum of squares over
     * the joints, over that of the openings [-]. */
    double opening = 0.;
    double largest_opening = 0.; ///< of the largest anywhere [m]
    /** Of principal stresses away from the base near the largest ones, as FaceTension::difference() [Pa]; not
     * a number: not recorded. */
    double tension_upstream = std::numeric_limits<double>::quiet_NaN(), tension_downstream = tension_upstream;
  };

  /** The same dam on its moving base at twice the time step, beside the run. The estimate is 0.4 of the
   * difference between both: an error that falls with the step's power p is 1/(2^p - 1) of it, so that the
   * estimate is right within a factor of 2 for p = 1.2 to 2.6 (doc/accuracy.md: what was measured). Where the
   * steps are so long that the error does not fall regularly, largest openings may be the same by chance; the
   * estimate is not less than a tenth of the largest difference of the openings at equal times. */
  class TimeErrorEstimate
  {
  public:
    /** @p dt: of the run. @p start: its state then, @p reference_jump: jumps at which the joints are
     * closed, 3 per pair [m]. All are kept. */
    TimeErrorEstimate(const Dam &dam, const ContactParameters &parameters, double dt, ImpactRule rule,
                      const DynamicState &start, const Unknowns &reference_jump);

    /** Tensions, too, from now on; @p tractions: known to @p stress, or null. Both are kept. */
    void record_stresses(const StressRecovery &stress, Tractions *tractions);

    /** After each step of the run, under @p load at its end and with the acceleration @p ground of the base
     * there [m/s^2]; every second one is a step here. */
    void advance(unsigned int step, const Unknowns &load, const Vector3 &base_velocity,
                 const Vector3 &ground);

    void collect() ///< as EnvelopeRecorder
    {
      if (envelope)
        envelope->collect();
    }

    TimeError of(const JointRecorder &joints, const EnvelopeRecorder &envelope,
                 const FaceTension &tension) const;

    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &joints &ground_before[0] & ground_before[1] & ground_before[2];
      if (envelope)
        archive &*envelope;
    }

  private:
    std::unique_ptr<Support> support; // before what stands on it

  public:
    Newmark newmark;

  private:
    void   record_stresses();
    double of_openings(const JointRecorder &joints) const; ///< [-]

    const Dam                      &dam;
    JointRecorder                   joints;
    std::optional<EnvelopeRecorder> envelope;
    Tractions                      *tractions = nullptr;
    Vector3                         ground_before{}; ///< at the end of the last step [m/s^2]
    Unknowns                        acceleration;    ///< mean of the last step [m/s^2]
  };
} // namespace Voussoir

#endif
