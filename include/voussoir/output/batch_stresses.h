// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_batch_stresses_h
#define voussoir_batch_stresses_h

#include <voussoir/dynamics/motion_batch.h>
#include <voussoir/output/observers.h>

namespace Voussoir
{
  /** Extremes of the stresses of all motions of a batch: the stresses of a node are computed for all motions together. */
  class BatchStresses
  {
  public:
    /** @param start state after the static state
     * @param observer of no motion
     * @param batch in the static state
     *
     * The arguments must outlive the object. */
    BatchStresses(const RunState &start, const StressObserver &observer, const MotionBatch &batch);

    /** Reads the velocities at the start of a step, if record() follows at its end. */
    void begin_step();

    /** Updates the extremes of the motions.
     * @param recorders of each motion; null: none
     * @param ground mean acceleration of the base in the last step for each lane [m/s^2]; empty: static state */
    void record(const std::vector<EnvelopeRecorder *> &recorders, const std::vector<Vector3> &ground);

    /** Completes the extremes of a motion after its last step. */
    void finish(EnvelopeRecorder &recorder, std::size_t lane) const;

  private:
    void find_tractions(const std::vector<Vector3> &ground);
    void update(EnvelopeRecorder &recorder, std::size_t lane, std::size_t node, double interval,
                const Stress &stress);
    void find_velocities(std::vector<float> &velocity) const;

    const RunState    &run;
    const MotionBatch &batch;
    const unsigned int lanes;
    StressView         view;
    std::vector<Stress>
                     at_rest; ///< stresses of the static state without tractions, with the initial ones [Pa]
    const Tractions *tractions;                                                          ///< null: unknown
    std::vector<float> maximum, minimum, of_faces, times_of_faces, of_tractions, forces; ///< see StressView
    std::vector<float> before, acceleration; ///< along the normals of Tractions::wet_faces [m/s], [m/s^2]
  };
} // namespace Voussoir

#endif
