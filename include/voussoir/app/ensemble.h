// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_ensemble_h
#define voussoir_ensemble_h

#include <voussoir/app/batch_run.h>
#include <voussoir/app/run_setup.h>

#include <functional>
#include <mutex>

namespace Voussoir
{
  /** Run of all motions of "Motion/Ensemble" from the same static state: in batches of the explicit scheme if possible
   * (why_no_batch()), otherwise one after another. The checkpoint has the results of the complete motions. */
  class EnsembleRun : private RunSetup
  {
  public:
    /** Returns the scene of one motion and its text with all defaults. */
    using SceneOf = std::function<std::pair<Scene, std::string>(const EnsembleMember &)>;

    /** @p scene: with "Motion/Ensemble". @p scene_text: the scene with all defaults. */
    EnsembleRun(const Scene &scene, const std::string &scene_text, const RunOptions &options,
                const SceneOf &scene_of);

    /** Executes the runs. Throws InputError, ComputationError (also if motions have no results, after all others),
     * WriteError or Interrupted. */
    void run();

  private:
    void              load();
    void              save();
    void              begin_files();
    void              run_one_by_one(const std::string &reason);
    void              run_batches();
    void              run_one(std::size_t number, bool keep_tables);
    void              run_batch(BatchRun &batch, const std::vector<std::size_t> &numbers, bool is_first);
    void              add(std::size_t number, MotionResult result);
    void              finish();
    [[noreturn]] void throw_interrupted() const;
    std::string       directory_of(std::size_t number) const;

    const SceneOf                     scene_of;
    const std::vector<EnsembleMember> members;
    EnsembleResults                   results;
    std::vector<char>                 is_done; ///< of each motion
    unsigned int                      lanes = 1;
    std::mutex                        results_mutex; ///< of results, checkpoint and log
    Stopwatch                         loop_clock, report_clock;
    std::size_t                       n_before = 0; ///< motions that were complete at the start
  };
} // namespace Voussoir

#endif
