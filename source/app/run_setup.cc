// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/memory_need.h>
#include <voussoir/app/modes_command.h>
#include <voussoir/app/run_report.h>
#include <voussoir/app/run_setup.h>
#include <voussoir/base/blas_buffers.h>
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/base/ranks.h>
#include <voussoir/dam/rock_wedge.h>
#include <voussoir/dam/static_path.h>
#include <voussoir/dynamics/leapfrog.h>
#include <voussoir/dynamics/mass_scaling.h>
#include <voussoir/motion/motion.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <iostream>

namespace Voussoir
{
  RunSetup::RunSetup(const Scene &scene, const std::string &scene_text, const RunOptions &options)
      : scene(scene), options(options),
        run_directory(options.output.empty() ? "output/" + scene.name : options.output),
        directory(run_directory.path), scene_text(scene_text), checkpoint(this->scene, scene_text, directory),
        log(options.quiet || options.json)
  {
  }

  void RunSetup::prepare(const std::vector<MotionParameters> &motions, const std::size_t of_setup)
  {
    check_ranks();
    if (options.resume && options.overwrite)
      throw InputError("--resume continues the run in " + directory +
                       ", but --overwrite replaces the run. Use only one of both options.");
    if (!options.validate)
    {
      take_blas_buffers();
      if (!InterruptGuard::lives())
        interrupt.emplace();
      claim_directory();
    }
    if (options.resume)
      state.start_step = checkpoint.open(log);
    make_motions(motions);
    read_input(all_motions[of_setup]);
    report_setup(state, options.validate && !options.json, log);
    if (options.validate)
      validate();
  }

  /** Throws InputError if the ranks have different command lines or input files. */
  void RunSetup::check_ranks() const
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

  void RunSetup::claim_directory()
  {
    std::vector<std::string> inputs = scene.sources;
    for (const auto &input : scene.input_files())
      inputs.push_back(input.second);
    Ranks::on_first([&] { run_directory.claim(options.resume, options.overwrite, inputs); });
  }

  /** Creates the dam. If the input file leaves the number of rock steps open, and the critical time step of the rock
   * requires several, the dam is created again with their number. */
  void RunSetup::make_dam()
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
      dam.set_damping(dam.facts.frequencies.empty() ? 0. : dam.facts.frequencies[0]);
      if (const std::string warning = damping.warning(dam.structure.damping.zones); !warning.empty())
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
      if (!dam.water)
        return;
      std::vector<double> mass;
      for (std::size_t i = 0; i < dam.structure.n_nodes(); ++i)
        mass.push_back(mass_of(dam.structure, rock.mass, i));
      const double of_rock = dam.scene.is_explicit() ? dam.foundation->largest_step() : INFINITY;
      dam.facts.critical_step = dam.water->with_dam().critical_step(dam.water->model_for(0.),
                                                                    std::min(critical.length, of_rock), mass);
      if (dam.facts.critical_step < .95 * std::min(critical.length, of_rock))
        dam.facts.critical_place += " and the water";
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

  /** Returns a ground motion with the time step of the dam and the factor of the combination. */
  GroundMotion RunSetup::motion_of_run(const MotionParameters &parameters) const
  {
    return make_motion(parameters, scene.directory)
        .refined(scene.steps_per_sample)
        .scaled(scene.loads.factor("earthquake"));
  }

  /** Creates all motions. Throws the error of the first one that is wrong. */
  void RunSetup::make_motions(const std::vector<MotionParameters> &motions)
  {
    all_motions.resize(motions.size());
    std::vector<std::exception_ptr> errors(motions.size());
#pragma omp parallel for schedule(dynamic)
    for (std::size_t k = 0; k < motions.size(); ++k)
      try
      {
        all_motions[k] = motion_of_run(motions[k]);
      }
      catch (...)
      {
        errors[k] = std::current_exception();
      }
    for (const std::exception_ptr &error : errors)
      if (error)
        std::rethrow_exception(error);
  }

  /** Reads the files of the scene and creates the dam. Throws InputError for invalid input. */
  void RunSetup::read_input(const GroundMotion &motion_of_setup)
  {
    GroundMotion &motion = state.motion;
    unsigned int &n_steps = state.n_steps;
    motion = motion_of_setup;
    n_steps = scene.moves_alone() || (scene.motion.source != "none" && scene.loads.factor("earthquake") != 0.)
                  ? motion.acceleration.size() - 1
                  : 0;
    rock_wedges(scene); // throws InputError before the dam is assembled
    check_water_size(scene, n_steps > 0 && !scene.is_explicit() ? motion.dt : 0., log);
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
      dam.water->prepare(n_steps > 0 ? motion.dt : 0., scene.steps_per_sample,
                         scene.is_explicit() ? scene.n_explicit : 0);
      for (const double depth : scene.output.pressure_depths)
        dam.water->point_at(depth); // throws InputError
    }
    if (checkpoint.provenance_now() != checkpoint.provenance)
      throw InputError("An input file of the scene changed while the program read it. Start the run again.");
    counters.setup = counters.clock.seconds();
  }

  /** Prints the warnings at the end of --validate, if --quiet or --json has suppressed the log, and the
   * JSON object. */
  void RunSetup::validate()
  {
    if (!Ranks::is_first())
      return;
    if (options.quiet || options.json)
      for (const Warning &warning : log.warnings())
        std::cerr << "voussoir: warning: " << warning.text << '\n';
    if (options.json)
      std::cout << json_of_setup(state, log).text() << '\n';
  }

  /** Returns the settings of the contact solver. Each @p stage has a separate directory for its problems. */
  ContactParameters RunSetup::contact_parameters(const std::string &stage) const
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
  const char *RunSetup::signal() const
  {
    const char *own = InterruptGuard::received();
    if (Ranks::any(own != nullptr ? 1 : 0) == 0)
      return nullptr;
    return own != nullptr ? own : "A signal to another process";
  }

  void RunSetup::stop_if_asked() const
  {
    if (const char *signal = this->signal())
      throw Interrupted(signal + std::string(" was received before the first step. ") +
                        (options.resume ? "The checkpoint is unchanged: continue with --resume."
                         : checkpoint.exists()
                             ? "The run has no checkpoint: start it again. The checkpoint in " + directory +
                                   " is of the previous run."
                             : "The run has no checkpoint: start it again."));
  }

  void RunSetup::find_static_state()
  {
    const Stopwatch watch;
    state.statics = static_state(*state.dam, contact_parameters("static"), log, [this] { stop_if_asked(); });
    state.pairs_at_start = state.statics.pairs;
    counters.statics = watch.seconds();
  }
} // namespace Voussoir
