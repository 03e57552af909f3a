// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/output/archive.h>
#include <voussoir/output/observers.h>

#include <cmath>

namespace Voussoir
{
  TimeErrorObserver::TimeErrorObserver(const RunState &run, const JointRecorder &joints,
                                       StressObserver &stresses, Log &log)
      : run(run), joints(joints), stresses(stresses), log(log)
  {
    if (run.n_steps == 0)
      return;
    const Scene      &scene = run.scene();
    ContactParameters parameters = scene.contact;
    parameters.write_problems = false;
    coarse_run = std::make_unique<TimeErrorEstimate>(*run.dam, parameters, run.motion.dt,
                                                     impact_rule(scene.impact_rule), run.newmark->state(),
                                                     run.statics);
    // The comparison run has every second time of the run. With longer intervals the run would miss peaks
    // that the comparison run records.
    if (scene.output.envelope_interval == 1 || scene.output.envelope_interval == 2)
      coarse_run->record_stresses(stresses.recovery, stresses.known_tractions());
  }

  void TimeErrorObserver::follow()
  {
    if (!coarse_run)
      return;
    try
    {
      const DynamicState &state = run.newmark->state();
      coarse_run->advance(run.step, state.load, state.base_velocity, run.ground_acceleration(run.step));
    }
    catch (const ComputationError &)
    {
      coarse_run.reset();
      const std::string time = "t = " + number_text(run.newmark->state().time) + " s";
      log.warn({Warning::Kind::input,
                "there will be no estimate of the error due to the time step (Dynamics/Error estimate): the "
                "comparison run with twice the time step stopped at " +
                    time +
                    ". This run continues and is not affected. Double \"Dynamics/Steps per sample\" for an "
                    "estimate.",
                time});
    }
  }

  void TimeErrorObserver::gather_on_root()
  {
    if (coarse_run)
      coarse_run->gather_on_root();
  }

  double TimeErrorObserver::memory_consumption() const
  {
    return coarse_run ? coarse_run->newmark.memory() : 0.;
  }

  void TimeErrorObserver::report(Log &log) const
  {
    if (!has_estimate())
      return;
    const TimeError error = this->error();
    if (!run.dam->structure.pairs.empty())
      log.line("          estimated error of the time step: all openings %.2g %%, largest opening %.2g mm",
               100. * error.opening, 1e3 * error.largest_opening);
    if (std::isfinite(error.extrapolated_opening))
      log.line("          largest opening extrapolated to a time step of zero: %.2f mm",
               1e3 * error.extrapolated_opening);
    if (std::isfinite(error.tension_upstream))
      log.line("          estimated error of the time step: largest tension %.2g MPa upstream, %.2g MPa "
               "downstream",
               1e-6 * error.tension_upstream, 1e-6 * error.tension_downstream);
  }

  Json TimeErrorObserver::json() const
  {
    const TimeError error = this->error();
    Json            json;
    json.add("openings", error.opening)
        .add("largest_opening", error.largest_opening)
        .add("tension_upstream", error.tension_upstream)
        .add("tension_downstream", error.tension_downstream);
    if (std::isfinite(error.extrapolated_opening))
      json.add("extrapolated_opening", error.extrapolated_opening);
    return json;
  }

  void TimeErrorObserver::save(boost::archive::binary_oarchive &archive) const
  {
    const bool is_estimating = coarse_run != nullptr;
    archive << is_estimating;
    if (!is_estimating)
      return;
    const DynamicState coarse_state = coarse_run->newmark.state();
    archive << coarse_state << *coarse_run;
  }

  void TimeErrorObserver::load(boost::archive::binary_iarchive &archive)
  {
    bool was_estimating = false;
    archive >> was_estimating;
    if (!was_estimating)
    {
      coarse_run.reset();
      return;
    }
    DynamicState coarse_state;
    archive >> coarse_state >> *coarse_run;
    coarse_run->newmark.resume(coarse_state, run.newmark->initial_energy(), run.newmark->largest_energy(),
                               run.statics.closed);
  }
} // namespace Voussoir
