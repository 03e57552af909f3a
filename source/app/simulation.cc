// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/run_report.h>
#include <voussoir/app/simulation.h>
#include <voussoir/base/error.h>
#include <voussoir/base/ranks.h>
#include <voussoir/output/energy_check.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    /** Returns the wall time of the neighbours in all time steps so far [s]. */
    double seconds_of(const std::vector<Neighbour *> &neighbours)
    {
      double sum = 0.;
      for (const Neighbour *neighbour : neighbours)
        sum += neighbour->seconds();
      return sum;
    }
  } // namespace

  void Simulation::run()
  {
    prepare({scene.motion});
    if (options.validate)
      return;
    start();
    Ranks::on_first([this] { begin_files(); });
    loop();
  }

  /** Computes the static state, and restores the checkpoint of a resumed run. */
  void Simulation::start()
  {
    find_static_state();
    const Stopwatch watch;
    state.start(contact_parameters("shaking"));
    observers.emplace(state);
    counters.statics += watch.seconds();
    if (state.n_steps > 0)
    {
      const std::vector<double> bytes = Ranks::of_all(state.integrator->memory());
      log.line("Shaking   %.2f s in %u steps of %g s; memory of joint operators and factors %.2f GiB",
               state.grid().duration(), state.n_steps, state.motion.dt,
               std::accumulate(bytes.begin(), bytes.end(), 0.) / std::pow(2., 30));
      log.line(
          "          newton: mean since the start; open, slip: pairs at this time; opening [mm], slip [mm], "
          "tension: largest since the start");
      log.line("\n   time  newton  open  slip  opening [mm]  slip [mm]  tension [MPa]  elapsed     left");
    }
    if (options.resume)
      checkpoint.load(state, *observers, counters, log);
    else
      for (Observer *observer : *observers)
        observer->start();
  }

  /** Creates the files of the run, after all input is checked. */
  void Simulation::begin_files()
  {
    run_directory.begin(options.resume, scene.contact.write_problems);
    log.open(directory + "/log.txt", options.resume);
    OutputFile out(directory + "/scene.prm");
    out << scene_text;
    out.check();
    write_tables_of_start(state, directory);
    for (Observer *observer : *observers)
      observer->open(directory);
    run_directory.expect_tables();
    if (!options.resume)
      record();
  }

  void Simulation::loop()
  {
    loop_clock = Stopwatch();
    ranks.start();
    const double       before = counters.shaking, cpu_before = counters.shaking_cpu;
    const std::clock_t cpu_start = std::clock();
    try
    {
      while (!state.is_last())
      {
        advance();
        on_first(
            [&]
            {
              record();
              counters.shaking = before + loop_clock.seconds();
              counters.shaking_cpu = cpu_before + double(std::clock() - cpu_start) / CLOCKS_PER_SEC;
              if (state.is_due(scene.output.progress_interval.samples) || state.is_last())
                report_step();
            });
        save_if_due();
      }
      ranks.gather(state);
      for (Observer *observer : *observers)
        observer->gather_on_root();
      on_first([this] { finish(); });
    }
    catch (const WriteError &error)
    {
      throw WriteError(error.what() + (is_inside_step
                                           ? std::string()
                                           : checkpoint.keep_last_state(state, *observers, counters)));
    }
  }

  /** Computes a step, and calls the observers. */
  void Simulation::advance()
  {
    const Stopwatch   watch;
    const SystemTimes before = state.integrator->times();
    const double      rock_before = seconds_of(state.dam->neighbours),
                 stresses_before = observers->stresses.seconds;
    try
    {
      is_inside_step = true;
      counters.add(solve_step());
      is_inside_step = false;
    }
    catch (const ComputationError &error)
    {
      try
      {
        if (Ranks::is_first())
          write_tables(); // for a diagnosis of the error
      }
      catch (const WriteError &) // only the first error is reported
      {
      }
      const bool resumable = checkpoint.exists();
      throw ComputationError(
          error.what() + (" The tables in " + directory) + " end before this step." +
          (resumable ? " --resume continues from the last checkpoint, with other values of section Contact. "
                       "Other changes require a new run, with --overwrite."
                     : ""));
    }
    for (Observer *observer : *observers)
      observer->follow();
    const SystemTimes &after = state.integrator->times();
    const double       substitutions = after.substitutions - before.substitutions,
                 joints = after.joints - before.joints,
                 rock = seconds_of(state.dam->neighbours) - rock_before;
    counters.substitutions += substitutions;
    counters.joints += joints;
    counters.rock += rock;
    counters.stepping +=
        watch.seconds() - substitutions - joints - rock - (observers->stresses.seconds - stresses_before);
  }

  /** Solves the equations of a step. */
  ContactResult Simulation::solve_step()
  {
    const Dam     &dam = *state.dam;
    Integrator    &integrator = *state.integrator;
    const double   memory_before = integrator.memory();
    const Unknowns v_before = integrator.state().v;
    Unknowns       load = state.next_load();
    for (Neighbour *neighbour : dam.neighbours)
      neighbour->advance(load);
    state.u_before = integrator.state().u;
    state.base_velocity_before = integrator.state().base_velocity;
    const ContactResult result = integrator.advance(load, dam.foundation->base_velocity());
    if (const double more = integrator.memory() - memory_before; more > 0.)
      log.line("          reduced time steps from t = %.4g s, required by the joints: additional factors of "
               "%.2f GiB%s",
               integrator.state().time, more / std::pow(2., 30),
               Ranks::size() > 1 ? " on the first rank" : "");
    for (Neighbour *neighbour : dam.neighbours)
      neighbour->update_from_dam(integrator.state());
    state.acceleration = mean_acceleration(
        v_before, integrator.state().v, state.motion.dt, state.ground_acceleration(state.step),
        state.ground_acceleration(state.step + 1), integrator.weight_of_end());
    ++state.step;
    return result;
  }

  /** Adds the results of the present time, on the first rank. */
  void Simulation::record()
  {
    const Stopwatch watch;
    try
    {
      for (Observer *observer : *observers)
        observer->record();
    }
    catch (const ComputationError &error)
    {
      write_tables();
      throw ComputationError(error.what() + (" The tables in " + directory) + " end before this step.");
    }
    for (Observer *observer : *observers)
      observer->flush();
    counters.output += watch.seconds();
  }

  void Simulation::save_if_due()
  {
    if (state.is_last())
      return;
    if (const char *signal = this->signal())
      keep_and_stop(signal);
    if (state.is_due(scene.output.checkpoint_interval.samples))
    {
      gather_on_root();
      Ranks::on_first([this] { checkpoint.save(state, *observers, counters); });
    }
  }

  /** Writes the results at the end, on the first rank. */
  void Simulation::finish()
  {
    const Stopwatch watch;
    write_tables();
    for (Observer *observer : *observers)
      observer->finish(directory, log);
    counters.output += watch.seconds();
    report_limits(state, *observers, log);
    for (const Observer *observer : *observers)
      observer->report(log);
    if (state.n_steps > 0)
      counters.report(state, observers->stresses.seconds, log);
    const double balance_error = observers->history.balance_error();
    log.line("Energy    error of the energy balance %.1e of the largest energy (limit %.0e)", balance_error,
             largest_balance_error);
    for (const Neighbour *neighbour : state.dam->neighbours)
      neighbour->report_balance(log);
    run_directory.expect_tables();
    write_summary(directory, state, *observers, counters, ranks, log); // with all warnings
    checkpoint.remove();                                               // the run is complete
    if (state.n_steps > 0)
      report_error_bars(scene, directory, log);
    if (scene.output.figures)
      report_figures(directory, log);
    log.line("Results   %s", directory.c_str());
    double of_neighbours = 0.; // or not a number
    for (const Neighbour *neighbour : state.dam->neighbours)
      if (const double error = neighbour->balance_error(); !(error <= of_neighbours))
        of_neighbours = error;
    if (state.n_steps > 0)
      check_energies(scene, balance_error, of_neighbours, directory);
  }

  /** Sends the state of neighbours and observers to the first rank. */
  void Simulation::gather_on_root()
  {
    for (Neighbour *neighbour : state.dam->neighbours)
      neighbour->gather_on_root();
    for (Observer *observer : *observers)
      observer->gather_on_root();
  }

  /** Runs @p action on the first rank. After an error, gathers the state there for a checkpoint. */
  void Simulation::on_first(const std::function<void()> &action)
  {
    try
    {
      Ranks::on_first(action);
    }
    catch (...)
    {
      gather_on_root();
      throw;
    }
  }

  MotionResult Simulation::result() const
  {
    return result_of(observers->joints, observers->stresses, assessment_of(state, *observers));
  }

  void Simulation::write_tables()
  {
    for (Observer *observer : *observers)
      observer->write_tables(directory);
  }

  void Simulation::report_step()
  {
    const auto           &pairs = state.integrator->pair_states();
    const JointRecorder  &joints = observers->joints.joints;
    const StressObserver &stresses = observers->stresses;
    const double          done = state.step - state.start_step, elapsed = loop_clock.seconds();
    log.line("%7.2f  %6.2f %5u %5u  %12.2f %10.2f  %13.2f  %7s  %7s", state.integrator->state().time,
             counters.newton / state.step,
             static_cast<unsigned int>(std::count(pairs.begin(), pairs.end(), PairState::open)),
             static_cast<unsigned int>(std::count(pairs.begin(), pairs.end(), PairState::slip)),
             1e3 * joints.opening.value, 1e3 * joints.slip.value,
             stresses.is_recording() ? 1e-6 * stresses.tension.headline(stresses.envelope) : 0.,
             clock_time(counters.wall_before + elapsed).c_str(),
             clock_time(elapsed / done * (state.n_steps - state.step)).c_str());
  }

  void Simulation::keep_and_stop(const char *signal)
  {
    gather_on_root();
    Ranks::on_first(
        [this]
        {
          checkpoint.save(state, *observers, counters);
          write_tables();
        });
    std::ostringstream message;
    message << signal << " at t = " << state.integrator->state().time << " s, after step " << state.step
            << " of " << state.n_steps << ". The tables so far and a checkpoint are in " << directory
            << ". Continue with the same command and --resume"
            << (options.overwrite ? " instead of --overwrite." : ".");
    throw Interrupted(message.str());
  }
} // namespace Voussoir
