// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_simulation_h
#define voussoir_simulation_h

#include <voussoir/app/run_setup.h>
#include <voussoir/output/ensemble_results.h>

#include <functional>

namespace Voussoir
{
  /** Run of a scene: setup, static state, time loop and results. */
  class Simulation : private RunSetup
  {
  public:
    /** @p scene_text: the scene with all defaults, for the output directory. */
    Simulation(const Scene &scene, const std::string &scene_text, const RunOptions &options)
        : RunSetup(scene, scene_text, options)
    {
    }

    /** Executes the run. Throws InputError, ComputationError, WriteError or Interrupted. */
    void run();

    /** Returns the results after run(), for an ensemble. */
    MotionResult result() const;

  private:
    void          start();
    void          begin_files();
    void          loop();
    void          advance();
    ContactResult solve_step();
    void          record();
    void          save_if_due();
    void          finish();
    void          gather_on_root();
    void          on_first(const std::function<void()> &action);
    void          write_tables();
    void          report_step();
    void          keep_and_stop(const char *signal);

    RankCounters                ranks;
    Stopwatch                   loop_clock;
    std::optional<RunObservers> observers;
    bool                        is_inside_step = false; ///< the state is incomplete
  };
} // namespace Voussoir

#endif
