// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_simulation_h
#define voussoir_simulation_h

#include <voussoir/app/checkpoint.h>
#include <voussoir/base/interrupt.h>
#include <voussoir/output/run_directory.h>

#include <functional>

namespace Voussoir
{
  /** Options of the command line for a run. */
  struct RunOptions
  {
    std::string output;            ///< directory of the results; empty: output/NAME
    bool        resume = false;    ///< continue from the last checkpoint
    bool        validate = false;  ///< setup and report only
    bool        overwrite = false; ///< replace a checkpoint; allow files of other programs
    bool        quiet = false;     ///< print errors only
    bool        json = false;      ///< with validate: print a JSON object
  };

  /** Run of a scene: setup, static state, time loop and results. */
  class Simulation
  {
  public:
    /** @p scene_text: the scene with all defaults, for the output directory. */
    Simulation(const Scene &scene, const std::string &scene_text, const RunOptions &options);

    /** Executes the run. Throws InputError, ComputationError, WriteError or Interrupted. */
    void run();

  private:
    void          check_ranks() const;
    void          claim_directory();
    void          make_dam();
    void          read_input();
    void          validate();
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

    ContactParameters contact_parameters(const std::string &stage) const;
    const char       *signal() const;
    void              stop_if_asked() const;
    void              keep_and_stop(const char *signal);

    Scene                         scene;
    const RunOptions              options;
    RunDirectory                  run_directory;
    const std::string             directory; ///< path of run_directory
    const std::string             scene_text;
    Checkpoint                    checkpoint;
    std::optional<InterruptGuard> interrupt; ///< empty with --validate
    Log                           log;
    RunCounters                   counters;
    RankCounters                  ranks;
    Stopwatch                     loop_clock;
    RunState                      state;
    std::optional<RunObservers>   observers;
    bool                          is_inside_step = false; ///< the state is incomplete
  };
} // namespace Voussoir

#endif
