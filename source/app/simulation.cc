// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/memory_need.h>
#include <voussoir/app/modes_command.h>
#include <voussoir/app/run_report.h>
#include <voussoir/app/simulation.h>
#include <voussoir/base/blas_buffers.h>
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/base/ranks.h>
#include <voussoir/dam/rock_wedge.h>
#include <voussoir/dam/static_path.h>
#include <voussoir/dynamics/leapfrog.h>
#include <voussoir/dynamics/mass_scaling.h>
#include <voussoir/motion/motion.h>
#include <voussoir/output/energy_check.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
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

  Simulation::Simulation(const Scene &scene, const std::string &scene_text, const RunOptions &options)
      : scene(scene), options(options),
        run_directory(options.output.empty() ? "output/" + scene.name : options.output),
        directory(run_directory.path), scene_text(scene_text), checkpoint(this->scene, scene_text, directory),
        log(options.quiet || options.json)
  {
  }

  void Simulation::run()
  {
    check_ranks();
    if (options.resume && options.overwrite)
      throw InputError("--resume continues the run in " + directory +
                       ", but --overwrite replaces the run. Use only one of both options.");
    if (!options.validate)
    {
      take_blas_buffers();
      interrupt.emplace();
      claim_directory();
    }
    if (options.resume)
      state.start_step = checkpoint.open(log);
    read_input();
    report_setup(state, options.validate && !options.json, log);
    if (options.validate)
      return validate();
    start();
    Ranks::on_first([this] { begin_files(); });
    loop();
  }

  /** Throws InputError if the ranks have different command lines or input files. */
  void Simulation::check_ranks() const
  {
    if (scene.is_explicit() && Ranks::size() > 1)
      throw InputError("\"Dynamics/Scheme\" = explicit runs in one process. Use threads (OMP_NUM_THREADS).");
    std::string text = scene_text + directory + (options.resume ? " resume" : "") +
                       (options.validate ? " validate" : "") + (options.overwrite ? " overwrite" : "");
    for (const auto &[name, value] : checkpoint.provenance)
      text += name + value;
    if (const unsigned int rank = Ranks::first_different(text); rank < Ranks::size())
      throw InputError(
          "The MPI processes of this run have different scenes or options: process " + std::to_string(rank) +
          " differs from process 0. Start all processes with the same command, with access to the "
          "same program, scene and files.");
  }

  void Simulation::claim_directory()
  {
    std::vector<std::string> inputs = scene.sources;
    for (const auto &input : scene.input_files())
      inputs.push_back(input.second);
    Ranks::on_first([&] { run_directory.claim(options.resume, options.overwrite, inputs); });
  }

  /** Creates the dam. If the input file leaves the number of rock steps open, and the critical time step of the rock
   * requires several, the dam is created again with their number. */
  void Simulation::make_dam()
  {
    state.dam = std::make_unique<Dam>(scene);
    FoundationParameters &foundation = scene.foundation;
    if (foundation.substeps > 0 || foundation.coupling != "auto" || scene.impact_rule != "mean-force" ||
        state.n_steps == 0 || scene.is_explicit())
      return;
    foundation.substeps =
        std::clamp(std::ceil(state.motion.dt / state.dam->foundation->largest_step()), 1., 100.);
    if (foundation.substeps == 1)
      return;
    state.dam.reset();
    state.dam = std::make_unique<Dam>(scene);
  }

  namespace
  {
    /** Sets uniform damping, which may depend on the first natural frequency of the dam. */
    void set_damping(Dam &dam, const bool moves)
    {
      const DampingParameters &damping = dam.scene.damping;
      if (!moves || !damping.is_uniform())
        return;
      if (damping.needs_first_frequency())
        dam.facts.frequencies = first_frequencies(dam.scene);
      dam.structure.damping = damping.law(dam.facts.frequencies.empty() ? 0. : dam.facts.frequencies[0]);
      if (const std::string warning = damping.warning(); !warning.empty())
        dam.facts.warnings.push_back(warning);
    }
  } // namespace

  namespace
  {
    /** Adds mass to the nodes that limit the critical step, for Scene::mass_scaling. @p rock: masses of the rock [kg]. */
    void scale_mass(Dam &dam, const std::vector<Matrix3> &rock)
    {
      const CriticalStep        before = critical_step(dam.structure, rock);
      const std::vector<double> added = mass_scaling(dam.structure, rock, dam.scene.mass_scaling / .95);
      double                    total = 0., of_dam = 0.;
      std::size_t               n = 0;
      for (std::size_t i = 0; i < added.size(); ++i)
      {
        of_dam += dam.structure.mass[i][0] - rock[i][0];
        total += added[i];
        n += added[i] > 0.;
        for (unsigned int c = 0; c < 3; ++c)
        {
          dam.structure.mass[i][4 * c] += added[i];
          dam.inertia[c][3 * i + c] -= added[i];
        }
      }
      if (n > 0)
        dam.facts.warnings.push_back("\"Dynamics/Mass scaling\" adds " + number_text(100. * total / of_dam) +
                                     " % to the mass of dam and water at " + std::to_string(n) + " of " +
                                     std::to_string(added.size()) + " nodes, most near the elements at " +
                                     dam.model->place_of(before.node) + " (critical step without it " +
                                     number_text(1e3 * before.length) +
                                     " ms). The results change; compare with a run without it.");
    }

    /** Computes the critical step of the dam, and where it comes from. */
    void find_critical_step(Dam &dam)
    {
      Structure rock;
      rock.mass.assign(dam.structure.n_nodes(), Matrix3{});
      dam.foundation->add_mass(rock);
      if (dam.scene.is_explicit() && dam.scene.mass_scaling > 0.)
        scale_mass(dam, rock.mass);
      const CriticalStep critical = critical_step(dam.structure, rock.mass);
      dam.facts.critical_step = critical.length;
      dam.facts.critical_place = dam.model->place_of(critical.node);
    }

    /** Returns the number of steps of the explicit scheme in a time step @p dt. Throws InputError if the wanted step is
     * too long, or very short. */
    unsigned int explicit_steps(const Dam &dam, const double dt)
    {
      constexpr double share_of_critical = .95, most_steps = 1e5;
      const double     of_rock = dam.foundation->largest_step(),
                   limit = std::min(dam.facts.critical_step, of_rock), step = dam.scene.explicit_step;
      const std::string critical =
          number_text(limit) + " s, of the " +
          (of_rock < dam.facts.critical_step ? "rock"
                                             : "dam, from the elements at " + dam.facts.critical_place);
      if (step > limit)
        throw InputError("Entry \"Dynamics/Explicit step\" = " + number_text(step) +
                         " s is above the critical step of " + critical + ". Set it to at most " +
                         number_text(share_of_critical * limit) + ", or to -1.");
      const double wanted = step > 0. ? step : share_of_critical * limit;
      if (!(dt / wanted < most_steps))
        throw InputError("Entry \"Dynamics/Explicit step\" = " + number_text(step) + " s: steps of " +
                         number_text(wanted) + " s divide a time step into more than " +
                         number_text(most_steps) + " parts (critical step of " + critical +
                         "). Increase the step, or mend the mesh.");
      return std::ceil(dt / wanted - 1e-9);
    }
  } // namespace

  /** Reads the files of the scene and creates the dam. Throws InputError for invalid input. */
  void Simulation::read_input()
  {
    const double  factor = scene.loads.factor("earthquake"); // of the combination
    GroundMotion &motion = state.motion;
    unsigned int &n_steps = state.n_steps;
    motion = make_motion(scene.motion, scene.directory).refined(scene.steps_per_sample).scaled(factor);
    n_steps = scene.moves_alone() || (scene.motion.source != "none" && factor != 0.)
                  ? motion.acceleration.size() - 1
                  : 0;
    rock_wedges(scene); // throws InputError before the dam is assembled
    check_water_size(scene, n_steps > 0 ? motion.dt : 0., log);
    make_dam();
    set_damping(*state.dam, n_steps > 0);
    if (n_steps > 0 && (scene.is_explicit() || options.validate))
      find_critical_step(*state.dam);
    if (n_steps > 0 && scene.is_explicit())
      scene.n_explicit = explicit_steps(*state.dam, motion.dt);
    const Dam &dam = *state.dam;
    loaded_wedges(scene, *dam.model); // throws InputError
    dam.initial_velocity();           // throws InputError
    if (!scene.statics.stages.empty())
      StaticPath{*state.dam};                                // throws InputError for an invalid stage
    if (n_steps > 0 && scene.motion.duration_is_automatic()) // in whole samples
      n_steps += scene.steps_per_sample *
                 std::ceil(dam.foundation->delay() / (scene.steps_per_sample * motion.dt) - 1e-9);
    if (n_steps > 0)
    {
      dam.foundation->check(state.grid(), scene.steps_per_sample);
      dam.foundation->check_stations(motion);
    }
    if (n_steps > 0 && scene.reservoir.model == "incompressible")
      throw InputError(
          "\"Reservoir/Model\" = incompressible has no earthquake: the mass of incompressible water "
          "couples all monoliths. Set the model to acoustic, whose water is compressible, or use "
          "`voussoir modes`.");
    if (dam.water)
    {
      dam.water->prepare(n_steps > 0 ? motion.dt : 0., scene.steps_per_sample);
      for (const double depth : scene.output.pressure_depths)
        dam.water->point_at(depth); // throws InputError
    }
    if (checkpoint.provenance_now() != checkpoint.provenance)
      throw InputError("An input file of the scene changed while the program read it. Start the run again.");
    counters.setup = counters.clock.seconds();
  }

  /** Prints the warnings at the end of --validate, if --quiet or --json has suppressed the log, and the
   * JSON object. */
  void Simulation::validate()
  {
    if (!Ranks::is_first())
      return;
    if (options.quiet || options.json)
      for (const Warning &warning : log.warnings())
        std::cerr << "voussoir: warning: " << warning.text << '\n';
    if (options.json)
      std::cout << json_of_setup(state, log).text() << '\n';
  }

  /** Computes the static state, and restores the checkpoint of a resumed run. */
  void Simulation::start()
  {
    Stopwatch watch;
    Dam      &dam = *state.dam;
    state.statics = static_state(dam, contact_parameters("static"), log, [this] { stop_if_asked(); });
    state.pairs_at_start = state.statics.pairs;
    counters.statics = watch.seconds();
    watch = Stopwatch();
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

  /** Returns the settings of the contact solver. Each @p stage has a separate directory for its problems. */
  ContactParameters Simulation::contact_parameters(const std::string &stage) const
  {
    ContactParameters parameters = scene.contact;
    parameters.write_directory = directory + "/contact/" + stage;
    if (!parameters.write_problems)
      return parameters;
    std::error_code error;
    std::filesystem::create_directories(parameters.write_directory, error);
    if (error)
      throw WriteError("The directory " + parameters.write_directory + " cannot be created: " +
                       error.message() + ". Choose another directory with --output.");
    if (options.resume)
      parameters.first_problem = stage == "shaking" ? state.start_step : 0;
    else
      for (const auto &entry : std::filesystem::directory_iterator(parameters.write_directory))
        if ((entry.path().extension() == ".txt" || entry.path().extension() == ".hdf5") &&
            entry.path().filename().string().rfind("problem-", 0) == 0)
          std::filesystem::remove(entry.path(), error); // of the previous run
    return parameters;
  }

  /** Returns the name of a received signal to stop, on any rank, or null. */
  const char *Simulation::signal() const
  {
    const char *own = interrupt->received();
    if (Ranks::any(own != nullptr ? 1 : 0) == 0)
      return nullptr;
    return own != nullptr ? own : "A signal to another process";
  }

  void Simulation::stop_if_asked() const
  {
    if (const char *signal = this->signal())
      throw Interrupted(signal + std::string(" was received before the first step. ") +
                        (options.resume ? "The checkpoint is unchanged: continue with --resume."
                         : checkpoint.exists()
                             ? "The run has no checkpoint: start it again. The checkpoint in " + directory +
                                   " is of the previous run."
                             : "The run has no checkpoint: start it again."));
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
