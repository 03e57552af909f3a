// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_batch_run_h
#define voussoir_batch_run_h

#include <voussoir/output/batch_stresses.h>
#include <voussoir/output/ensemble_results.h>

namespace Voussoir
{
  /** Returns the reason why the motions of a scene cannot run in batches, for a sentence after "because", or an empty
   * text. @p run: after the static state. */
  std::string why_no_batch(const RunState &run);

  /** Run of up to n_lanes() motions together. */
  class BatchRun
  {
  public:
    /** @param start state after the static state
     * @param model model of its dam
     * @param observer observer of no motion, whose operator all motions share
     * @param motions as RunState::motion
     *
     * All arguments must outlive the object. */
    BatchRun(const RunState &start, const BatchModel &model, const StressObserver &observer,
             const std::vector<const GroundMotion *> &motions);

    ~BatchRun();

    unsigned int n_steps() const { return most_steps; } ///< of the longest motion

    /** Advances all motions by a time step. Call it n_steps() times. */
    void advance();

    /** Returns the result of a motion after the last step, also with a failure. */
    MotionResult result(std::size_t motion) const;

  private:
    struct Lane;
    std::vector<EnvelopeRecorder *> recorders() const;

    MotionBatch                        batch;
    const unsigned int                 envelope_interval; ///< [steps]
    unsigned int                       step = 0, most_steps = 0;
    std::optional<BatchStresses>       stresses;
    std::vector<std::unique_ptr<Lane>> lanes;
  };
} // namespace Voussoir

#endif
