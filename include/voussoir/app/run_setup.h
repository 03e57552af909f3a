// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_run_setup_h
#define voussoir_run_setup_h

#include <voussoir/app/checkpoint.h>
#include <voussoir/base/interrupt.h>
#include <voussoir/output/run_directory.h>

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

  /** Part of a run before its time loop: output directory, ground motions, dam, report of the setup, static state. */
  class RunSetup
  {
  protected:
    /** @p scene_text: the scene with all defaults, for the output directory. */
    RunSetup(const Scene &scene, const std::string &scene_text, const RunOptions &options);

    /** Reads all input, creates the dam and prints the setup. With --validate, ends the report. Throws InputError.
     * @param motions ground motions of the runs
     * @param of_setup index of the motion that the report of the setup describes */
    void prepare(const std::vector<MotionParameters> &motions, std::size_t of_setup = 0);

    /** Computes RunState::statics. Throws ComputationError, or Interrupted after a signal. */
    void find_static_state();

    ContactParameters contact_parameters(const std::string &stage) const;
    const char       *signal() const;
    void              stop_if_asked() const;

    Scene                         scene;
    const RunOptions              options;
    RunDirectory                  run_directory;
    const std::string             directory; ///< path of run_directory
    const std::string             scene_text;
    Checkpoint                    checkpoint;
    std::optional<InterruptGuard> interrupt; ///< empty with --validate, or if another run has the guard
    Log                           log;
    RunCounters                   counters;
    RunState                      state;
    std::vector<GroundMotion>     all_motions; ///< of prepare(), as in RunState::motion

  private:
    void         check_ranks() const;
    void         claim_directory();
    void         make_dam();
    void         make_motions(const std::vector<MotionParameters> &motions);
    void         read_input(const GroundMotion &motion_of_setup);
    void         validate();
    GroundMotion motion_of_run(const MotionParameters &parameters) const;
  };
} // namespace Voussoir

#endif
