// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/simulation.h>
#include <voussoir/base/blas_buffers.h>
#include <voussoir/base/error.h>
#include <voussoir/base/ranks.h>
#include <voussoir/dam/face_pressure.h>
#include <voussoir/dam/static_path.h>
#include <voussoir/motion/motion.h>
#include <voussoir/motion/motion_report.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <numeric>

namespace Voussoir
{
  Simulation::Simulation(const Scene &scene, const std::string &scene_text, const RunOptions &options)
      : scene(scene), scene_text(scene_text), options(options),
        run_directory(options.output.empty() ? "output/" + scene.name : options.output),
        directory(run_directory.path), log(options.quiet)
  {
  }

  /** One run is started with one command, on machines that see the same files. */
  void Simulation::check_ranks() const
  {
    std::string text = scene_text + directory + (options.resume ? " resume" : "") +
                       (options.validate ? " validate" : "") + (options.overwrite ? " overwrite" : "");
    for (const auto &[name, value] : provenance)
      text += name + value;
    if (!Ranks::have_same(text))
      throw InputError("The ranks of this run have different scenes: start all with the same command, where "
                       "all see the same program, scene and files.");
  }

  void Simulation::run()
  {
    provenance = provenance_now();
    check_ranks();
    if (!options.validate)
      take_blas_buffers();
    if (options.validate && options.resume)
      open_checkpoint();
    if (!options.validate)
    {
      interrupt.emplace();
      std::vector<std::string> inputs = scene.sources;
      for (const auto &input : scene.input_files())
        inputs.push_back(input.second);
      Ranks::on_first([&] { run_directory.claim(options.resume, options.overwrite, inputs); });
      if (options.resume)
        open_checkpoint();
    }
    read_input();
    if (provenance_now() != provenance)
      throw InputError("A file that the scene names has changed while it was read. Run again.");
    report_setup();
    if (options.validate)
    {
      if (options.quiet && Ranks::is_first())
        for (const std::string &warning : log.warnings())
          std::cerr << "voussoir: warning: " << warning << '\n';
      return;
    }
    find_static_state();
    start_shaking();
    if (options.resume)
      load_checkpoint();

    if (!options.resume)
      record_stresses();
    Ranks::on_first([this] { begin_files(); });
    shake();
  }

  void Simulation::begin_files()
  {
    run_directory.begin(options.resume, scene.contact.write_problems); // all input is read and found good
    log.open(directory + "/log.txt", options.resume);
    OutputFile out(directory + "/scene.prm");
    out << scene_text;
    out.check();
    open_tables();
    if (!options.resume)
      record();
    else if (scene.output.solution_interval > 0 && step % scene.output.solution_interval == 0 &&
             (solutions.empty() || solutions.back().first != newmark->state().time))
      write_solution(); // what a full disk kept from being written
  }

  /** All files that the scene names; InputError for what cannot be run. */
  void Simulation::read_input()
  {
    const double factor = scene.loads.factor("earthquake"); // of the combination
    motion = make_motion(scene.motion, scene.directory).refined(scene.steps_per_sample).scaled(factor);
    n_steps = scene.motion.source == "none" || factor == 0. ? 0 : motion.acceleration.size() - 1;
    dam = std::make_unique<Dam>(scene);
    if (!scene.statics.stages.empty())
      StaticPath{*dam};                                      // can all of them be?
    if (n_steps > 0 && scene.motion.duration_is_automatic()) // by whole samples
      n_steps += scene.steps_per_sample *
                 std::ceil(dam->foundation->delay() / (scene.steps_per_sample * motion.dt) - 1e-9);
    if (n_steps > 0)
      dam->foundation->check(grid(), scene.steps_per_sample);
    count.seconds_setup = clock.seconds();
  }

  void Simulation::shake()
  {
    shaking_clock = Stopwatch();
    per_rank.work_before = Ranks::work();
    per_rank.messages_before = Ranks::n_messages();
    const double       before = count.seconds_shaking, cpu_so_far = count.cpu_shaking;
    const std::clock_t start = std::clock();
    try
    {
      for (first_step = step; step < n_steps;)
      {
        step_once();
        record_stresses();
        record_on_first(
            [&]
            {
              record();
              count.seconds_shaking = before + shaking_clock.seconds();
              count.cpu_shaking = cpu_so_far + double(std::clock() - start) / CLOCKS_PER_SEC;
              if (step % scene.output.progress_interval == 0 || step == n_steps)
                report_step();
            });
        if (const char *signal = step < n_steps ? this->signal() : nullptr)
          keep_and_stop(signal);
        if (scene.output.checkpoint_interval > 0 && step % scene.output.checkpoint_interval == 0 &&
            step < n_steps)
        {
          collect();
          Ranks::on_first([this] { save_checkpoint(); });
        }
      }
      gather_per_rank();
      record_on_first(
          [this]
          {
            write_results();
            check_balance();
          });
    }
    catch (const WriteError &error)
    {
      throw WriteError(error.what() + keep_last_state());
    }
  }

  void Simulation::step_once()
  {
    try
    {
      inside_step = true;
      advance();
      inside_step = false;
    }
    catch (const ComputationError &error)
    {
      try
      {
        if (Ranks::is_first())
          write_tables(); // what there is, to see what went wrong
      }
      catch (const WriteError &) // the first error is the one to tell
      {
      }
      const bool resumable = std::filesystem::exists(checkpoint_name());
      throw ComputationError(
          error.what() + (" The tables in " + directory) + " end before it" +
          (resumable ? "; the last checkpoint is there, too: go on from it with --resume." : "."));
    }
  }

  /** Those of the scene; the problems of this @p stage go to a directory of their own. */
  ContactParameters Simulation::contact_parameters(const std::string &stage) const
  {
    ContactParameters parameters = scene.contact;
    parameters.write_directory = directory + "/contact/" + stage;
    if (!parameters.write_problems)
      return parameters;
    std::error_code error;
    std::filesystem::create_directories(parameters.write_directory, error);
    if (error)
      throw WriteError("The directory " + parameters.write_directory + " cannot be made: " + error.message() +
                       ".");
    if (options.resume)
      parameters.first_problem = stage == "shaking" ? start_step : 0;
    else
      for (const auto &entry : std::filesystem::directory_iterator(parameters.write_directory))
        if (entry.path().extension() == ".hdf5" && entry.path().filename().string().rfind("problem-", 0) == 0)
          std::filesystem::remove(entry.path(), error); // of the run before
    return parameters;
  }

  namespace
  {
    std::unique_ptr<JointRecorder> recorder_of_joints(const Dam &dam)
    {
      const Structure &structure = dam.structure;
      auto             joints = std::make_unique<JointRecorder>(structure, *dam.geometry);
      joints->reach = JointReach(*dam.model, structure.pairs);
      joints->points =
          JointPoints(*dam.model, structure.pairs, structure.n_joints, dam.scene.limits.waterstop_depth);
      joints->keys = KeyForces(structure, dam.scene.joints);
      return joints;
    }
  } // namespace

  void Simulation::find_static_state()
  {
    const Stopwatch watch;
    statics = static_state(*dam, contact_parameters("static"), log, [this] { stop_if_asked(); });
    pairs_at_start = statics.pairs;
    count.seconds_static = watch.seconds();
  }

  void Simulation::start_foundation()
  {
    dam->foundation->start(motion, grid(), statics.u);
  }

  void Simulation::start_shaking()
  {
    const Stopwatch  watch;
    const Structure &structure = dam->structure;
    if (n_steps > 0)
      start_foundation();
    newmark = std::make_unique<Newmark>(
        structure, dam->laws, contact_parameters("shaking"), motion.dt, impact_rule(scene.impact_rule),
        n_steps > 0 ? dam->foundation->support(dam->structure) : nullptr, scene.has_single_factors());
    Unknowns load = statics.load;
    if (n_steps > 0 && dam->foundation->moves_base())
      for (unsigned int d = 0; d < 3; ++d)
        for (std::size_t k = 0; k < load.size(); ++k)
          load[k] += motion.acceleration[0][d] * dam->inertia[d][k];
    newmark->start(statics.u, Unknowns(statics.u.size(), 0.), statics.force, load, statics.closed,
                   statics.memory);

    stability = std::make_unique<StabilityWatch>(*dam, motion, *newmark);
    joints = recorder_of_joints(*dam);
    tractions = std::make_unique<Tractions>(
        *dam->model, structure, known_traction(scene), dam->initial_stress, statics.joint_water,
        dam->added_mass > 0. ? added_mass_per_area(*dam->model, scene.reservoir) : std::vector<double>());
    stress = std::make_unique<StressRecovery>(*dam->model, dam->materials, scene.elements.incompatible_modes,
                                              scene.output.knows_tractions() ? tractions->faces
                                                                             : std::vector<NodeFace>(),
                                              scene.output.knows_tractions());
    tension = std::make_unique<FaceTension>(*dam->model);
    envelope = std::make_unique<EnvelopeRecorder>(*stress, dam->initial_stress);
    envelope->overstress = Overstress(scene.limits.tensile_strength, dam->model->n_nodes());
    if (scene.error_estimate && n_steps > 1)
    {
      ContactParameters parameters = scene.contact;
      parameters.write_problems = false;
      companion = std::make_unique<TimeErrorEstimate>(
          *dam, parameters, motion.dt, impact_rule(scene.impact_rule), newmark->state(), statics.closed);
      // The companion has every second time of the run: sampled less often, the run would miss peaks that the
      // companion has.
      if (scene.output.envelope_interval == 1 || scene.output.envelope_interval == 2)
        companion->record_stresses(*stress, scene.output.knows_tractions() ? tractions.get() : nullptr);
    }
    declare_tables();
    count.seconds_static += watch.seconds();
    if (n_steps > 0)
    {
      const std::vector<double> bytes =
          Ranks::of_all(newmark->memory() + (companion ? companion->newmark.memory() : 0.));
      log.line("Shaking   %.2f s in %u steps of %g s; joints and factors hold %.2f GiB", grid().duration(),
               n_steps, motion.dt, std::accumulate(bytes.begin(), bytes.end(), 0.) / std::pow(2., 30));
      log.line("\n   time  newton  open  slip  opening [mm]  slip [mm]  tension [MPa]  elapsed     left");
    }
  }

  void Simulation::advance()
  {
    const Stopwatch watch;
    const double    rock_before = dam->foundation->seconds();
    Unknowns        load = statics.load;
    const Vector3   a = motion.sample(step + 1);
    for (std::size_t k = 0; dam->foundation->moves_base() && k < load.size(); ++k)
      load[k] += a[0] * dam->inertia[0][k] + a[1] * dam->inertia[1][k] + a[2] * dam->inertia[2][k];
    dam->foundation->advance(load);
    const SystemTimes   before = newmark->joint_system().times;
    const Vector3       base_velocity = dam->foundation->base_velocity();
    const double        memory_before = newmark->memory();
    const Unknowns      v_before = newmark->state().v, u_before = newmark->state().u;
    const Vector3       base_before = newmark->state().base_velocity;
    const ContactResult result = newmark->advance(load, base_velocity);
    const Vector3       ground = ground_acceleration(step + 1);
    acceleration =
        mean_acceleration(v_before, newmark->state().v, motion.dt, ground_acceleration(step), ground);
    follow_blocks(u_before, base_before);
    if (const double more = newmark->memory() - memory_before; more > 0.)
      log.line(
          "          smaller steps from t = %.4g s on, where joints ask for them: factors of %.2f GiB more%s",
          newmark->state().time, more / std::pow(2., 30), Ranks::size() > 1 ? " on the first rank" : "");
    dam->foundation->follow(newmark->state());
    advance_companion(load, base_velocity, ground);
    ++count.path[static_cast<unsigned int>(result.path)];
    ++step;
    const double rock_seconds = dam->foundation->seconds() - rock_before;
    count.seconds_rock += rock_seconds;
    const SystemTimes &after = newmark->joint_system().times;
    count.seconds_substitutions += after.substitutions - before.substitutions;
    count.seconds_joints += after.joints - before.joints;
    count.seconds_stepping += watch.seconds() - (after.substitutions - before.substitutions) -
                              (after.joints - before.joints) - rock_seconds;
    count.newton += result.iterations;
    count.newton_max = std::max<double>(count.newton_max, result.iterations);
    count.krylov += result.krylov;
    count.factorisations += result.factorisations;
    count.gauss_seidel += result.sweeps;
    count.residual = std::max(count.residual, result.residual);
    count.imbalance =
        std::max(count.imbalance, std::abs(newmark->state().energy.balance(newmark->initial_energy())));
  }

  /** Of the base that the displacements count from, after so many steps [m/s^2]. */
  Vector3 Simulation::ground_acceleration(const unsigned int after) const
  {
    return dam->foundation->moves_base() ? motion.acceleration[after] : Vector3{};
  }

  /** An estimate that cannot be had is no reason to end the run. */
  void Simulation::advance_companion(const Unknowns &load, const Vector3 &base_velocity,
                                     const Vector3 &ground)
  {
    try
    {
      if (companion)
        companion->advance(step + 1, load, base_velocity, ground);
    }
    catch (const ComputationError &error)
    {
      companion.reset();
      log.line("warning: there will be no estimate of the error that the time step makes (Dynamics/Error "
               "estimate): with twice the step the joints did not converge. %s",
               error.what());
    }
  }

} // namespace Voussoir
