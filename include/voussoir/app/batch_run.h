// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_batch_run_h
#define voussoir_batch_run_h

#include <voussoir/dynamics/motion_batch.h>
#include <voussoir/output/ensemble_results.h>

namespace Voussoir
{
  /** Returns the reason why the motions of a scene cannot run in batches, for a sentence after "because", or an empty
   * text. @p run: after the static state. */
  std::string why_no_batch(const RunState &run);

  /** Run of up to MotionBatch::n_lanes() motions together. */
  class BatchRun
  {
  public:
    /** @param start state after the static state
     * @param model model of its dam
     * @param stresses observer of no motion, whose operator all motions share
     * @param motions as RunState::motion
     *
     * All arguments must outlive the object. */
    BatchRun(const RunState &start, const BatchModel &model, const StressObserver &stresses,
             const std::vector<const GroundMotion *> &motions);

    ~BatchRun();

    unsigned int n_steps() const { return most_steps; } ///< of the longest motion

    /** Advances all motions by a time step. Call it n_steps() times. */
    void advance();

    /** Returns the result of a motion after the last step, also with a failure. */
    MotionResult result(std::size_t motion) const;

  private:
    struct Lane;
    MotionBatch                        batch;
    unsigned int                       step = 0, most_steps = 0;
    std::vector<std::unique_ptr<Lane>> lanes;
  };
} // namespace Voussoir

#endif
