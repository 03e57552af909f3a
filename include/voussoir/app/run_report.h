// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_run_report_h
#define voussoir_run_report_h

#include <voussoir/app/run_counters.h>
#include <voussoir/app/run_observers.h>
#include <voussoir/output/assessment.h>

namespace Voussoir
{
  /** Prints mesh, materials, joints, foundation, loads, ground motion and warnings. @p validate: also prints
   * groups, unknowns, steps and memory. */
  void report_setup(const RunState &run, bool validate, Log &log);

  /** Prints warnings about the size and the end of a motion. @p name: text before each warning */
  void report_motion_warnings(const GroundMotion &motion, const Scene &scene, const std::string &name,
                              Log &log);

  /** Returns the assessment of the results so far. */
  Assessment assessment_of(const RunState &run, const RunObservers &observers);

  /** Returns the model of a run as one object: the output of --validate --json. */
  Json json_of_setup(const RunState &run, const Log &log);

  /** Prints the static loads. */
  void report_loads(const Dam &dam, Log &log);

  /** Returns factors and resultants [N] of the static loads: "loads" of summary.json. */
  Json json_of_loads(const Dam &dam);

  /** Writes spectrum.csv of the ground motion and stages.csv of the static state. Throws WriteError. */
  void write_tables_of_start(const RunState &run, const std::string &directory);

  /** Prints the error bars of a completed run, and adds the bars to summary.json. `voussoir accuracy` has computed the
   * bars in directory/accuracy, or in SCENE-accuracy next to the directory; otherwise a line names this command. */
  void report_error_bars(const Scene &scene, const std::string &directory, Log &log);

  /** Draws the figures of a completed run. Prints a warning if this fails. */
  void report_figures(const std::string &directory, Log &log);

  /** Prints which limits are satisfied. */
  void report_limits(const RunState &run, const RunObservers &observers, Log &log);

  /** Writes summary.json with the warnings of the log so far. Throws WriteError. */
  void write_summary(const std::string &directory, const RunState &run, const RunObservers &observers,
                     const RunCounters &counters, const RankCounters &ranks, const Log &log);

  /** Writes summary.json of an ensemble. @p ensemble: EnsembleResults::json(). Throws WriteError. */
  void write_ensemble_summary(const std::string &directory, const RunState &run, const Json &ensemble,
                              const RunCounters &counters, const Log &log);
} // namespace Voussoir

#endif
