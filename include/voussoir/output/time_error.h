// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_time_error_h
#define voussoir_time_error_h

#include <voussoir/dam/dam.h>
#include <voussoir/dam/static_state.h>
#include <voussoir/dam/tractions.h>
#include <voussoir/dynamics/newmark.h>
#include <voussoir/output/face_tension.h>

#include <limits>
#include <optional>

namespace Voussoir
{
  /** Estimated error of a run's extremes due to the time step. */
  struct TimeError
  {
    /** Relative error of the joints' largest openings at the crest, upstream and downstream [-]: root of the
     * sum of squared errors over the root of the sum of squared openings. */
    double opening = 0.;
    double largest_opening = 0.; ///< error of the largest opening anywhere [m]
    /** Largest opening extrapolated to a time step of zero, with order 2 (Richardson) [m]. NaN: the estimate of all
     * openings exceeds 1 %, where the order of single values is not reliable. */
    double extrapolated_opening = std::numeric_limits<double>::quiet_NaN();
    /** Error of the largest maximum principal stresses away from the base, as in FaceTension::difference()
     * [Pa]. NaN: stresses are not recorded. */
    double tension_upstream = std::numeric_limits<double>::quiet_NaN(), tension_downstream = tension_upstream;
  };

  /** Comparison run of the same dam with twice the time step, parallel to the run. The estimate is 0.4 of the
   * difference of both runs. An error of order p is 1/(2^p - 1) of the difference, so the estimate is
   * accurate within a factor of 2 for p = 1.2 to 2.6 (measured errors: doc/accuracy.md). With long time
   * steps, the largest openings of both runs may agree by chance. The estimate is therefore at least a tenth
   * of the largest difference of the openings at equal times. */
  class TimeErrorEstimate
  {
  public:
    /** Starts the comparison run.
     * @param dam dam; must outlive the object
     * @param parameters parameters of the contact solver
     * @param dt time step of the run [s]; the comparison run has 2 dt
     * @param rule velocity correction of closed pairs
     * @param start state of the run at its start
     * @param statics static state of the run; must outlive the object */
    TimeErrorEstimate(const Dam &dam, const ContactParameters &parameters, double dt, ImpactRule rule,
                      const DynamicState &start, const StaticState &statics);

    /** Starts the records of stresses. Both arguments must outlive the object.
     * @param stress computes the stresses
     * @param tractions boundary tractions that @p stress uses; nullptr: none */
    void record_stresses(const StressRecovery &stress, Tractions *tractions);

    /** Advances the comparison run in every second call. The time loop calls it after each step of the run.
     * @param step number of steps done by the run
     * @param load loads at the end of the step, three values per node [N]
     * @param base_velocity velocity of the base, as in Newmark::advance() [m/s]
     * @param ground acceleration of the base at the end of the step [m/s^2] */
    void advance(unsigned int step, const Unknowns &load, const Vector3 &base_velocity,
                 const Vector3 &ground);

    /** Gathers the stresses of all nodes on every rank. All ranks must call it. */
    void gather_on_root()
    {
      if (envelope)
        envelope->gather();
    }

    /** Returns the estimate.
     * @param joints joint results of the run
     * @param envelope stress envelope of the run
     * @param tension evaluation of the envelope */
    TimeError of(const JointRecorder &joints, const EnvelopeRecorder &envelope,
                 const FaceTension &tension) const;

    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &joints &ground_before[0] & ground_before[1] & ground_before[2];
      if (envelope)
        archive &*envelope;
    }

  private:
    std::unique_ptr<Support> support; // constructed before newmark, which uses it

  public:
    Newmark newmark; ///< time integration of the comparison run

  private:
    void   record_stresses();
    double of_openings(const JointRecorder &joints) const; ///< [-]

    const Dam                      &dam;
    const StaticState              &statics;
    JointRecorder                   joints;
    std::optional<EnvelopeRecorder> envelope;
    Tractions                      *tractions = nullptr;
    Vector3                         ground_before{}; ///< at the end of the previous step [m/s^2]
    Unknowns                        acceleration;    ///< mean of the last step [m/s^2]
  };
} // namespace Voussoir

#endif
