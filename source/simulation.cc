#include <voussoir/error.h>
#include <voussoir/simulation.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace Voussoir
{
  Simulation::Simulation(const Scene &scene, const std::string &scene_text, const RunOptions &options)
      : scene(scene), scene_text(scene_text), options(options),
        directory(options.output.empty() ? "output/" + scene.name : options.output), log(options.quiet)
  {
  }

  namespace
  {
    /** The motion with @p n steps in each sampling interval. */
    GroundMotion refined(const GroundMotion &motion, const unsigned int n)
    {
      if (n == 1 || motion.acceleration.empty())
        return motion;
      GroundMotion result;
      result.dt = motion.dt / n;
      for (std::size_t k = 0; k + 1 < motion.acceleration.size(); ++k)
        for (unsigned int i = 0; i < n; ++i)
        {
          std::array<double, 3> a;
          for (unsigned int c = 0; c < 3; ++c)
            a[c] = motion.acceleration[k][c] +
                   double(i) / n * (motion.acceleration[k + 1][c] - motion.acceleration[k][c]);
          result.acceleration.push_back(a);
        }
      result.acceleration.push_back(motion.acceleration.back());
      return result;
    }

    /** x += f - sum of g (dx + df), the coefficients g those that make f - sum of g df smallest. */
    void accelerate(std::vector<Unknowns> df, std::vector<Unknowns> dx, Unknowns f, Unknowns &x)
    {
      const auto dot_product = [](const Unknowns &a, const Unknowns &b)
      {
        double sum = 0.;
        for (std::size_t k = 0; k < a.size(); ++k)
          sum += a[k] * b[k];
        return sum;
      };
      for (std::size_t j = df.size(); j-- > 0;) // the newest first: Gram-Schmidt
      {
        const double before = dot_product(df[j], df[j]);
        for (std::size_t i = df.size(); i-- > j + 1;)
          if (const double square = dot_product(df[i], df[i]); square > 0.)
          {
            const double factor = dot_product(df[i], df[j]) / square;
            for (std::size_t k = 0; k < x.size(); ++k)
            {
              df[j][k] -= factor * df[i][k];
              dx[j][k] -= factor * dx[i][k];
            }
          }
        const double square = dot_product(df[j], df[j]);
        if (square <= 1e-20 * before)
        {
          std::fill(df[j].begin(), df[j].end(), 0.);
          continue;
        }
        const double factor = dot_product(df[j], f) / square;
        for (std::size_t k = 0; k < x.size(); ++k)
        {
          f[k] -= factor * df[j][k];
          x[k] -= factor * dx[j][k];
        }
      }
      for (std::size_t k = 0; k < x.size(); ++k)
        x[k] += f[k];
    }
  } // namespace

  void Simulation::run()
  {
    if (options.resume && !std::filesystem::exists(directory + "/checkpoint.bin"))
      throw InputError("There is no checkpoint " + directory +
                       "/checkpoint.bin to resume from: the run has ended, or never reached one. Run "
                       "without --resume, or name the output directory of the run with --output.");
    if (!options.validate)
    {
      std::error_code error;
      std::filesystem::create_directories(directory, error);
      if (error || !std::ofstream(directory + "/scene.prm", std::ios::app))
        throw InputError("The output directory " + directory +
                         " cannot be written to. Choose another one with --output.");
      if (!options.resume)
        remove_old_results();
      log.open(directory + "/log.txt", options.resume);
      if (!options.resume) // else only when the checkpoint belongs to this scene
        std::ofstream(directory + "/scene.prm") << scene_text;
    }
    motion = refined(make_motion(scene.motion, scene.directory), scene.steps_per_sample);
    n_steps = scene.motion.source == "none" ? 0 : motion.acceleration.size() - 1;
    dam = std::make_unique<Dam>(scene);
    if (dam->foundation && n_steps > 0)
      if (const double critical = dam->foundation->critical_time_step(),
          rock_dt = motion.dt / scene.foundation.substeps;
          rock_dt > critical)
      {
        std::ostringstream message;
        message << "The time step " << rock_dt << " s is too large for the rock: its critical time step is "
                << critical << " s. Raise \"Dynamics/Steps per sample\" to "
                << std::ceil(scene.steps_per_sample * rock_dt / critical) << " or \"Foundation/Substeps\" to "
                << std::ceil(motion.dt / critical)
                << ", take larger rock elements, or less \"Foundation/Stiffness damping\".";
        throw InputError(message.str());
      }
    count.seconds_setup = clock.seconds();
    report_setup();
    if (options.validate)
      return;

    find_static_state();
    start_shaking();
    if (options.resume)
    {
      load_checkpoint();
      std::ofstream(directory + "/scene.prm") << scene_text;
    }
    else
      record();
    shaking_clock = Stopwatch();
    const double before = count.seconds_shaking;
    for (first_step = step; step < n_steps;)
    {
      try
      {
        advance();
      }
      catch (const ComputationError &error)
      {
        write_tables(); // what there is, to see what went wrong
        const bool resumable = std::filesystem::exists(directory + "/checkpoint.txt");
        throw ComputationError(
            error.what() + (" The tables in " + directory) + " end before it" +
            (resumable ? "; the last checkpoint is there, too: go on from it with --resume." : "."));
      }
      record();
      count.seconds_shaking = before + shaking_clock.seconds();
      if (step % scene.output.progress_interval == 0 || step == n_steps)
        report_step();
      if (scene.output.checkpoint_interval > 0 && step % scene.output.checkpoint_interval == 0 &&
          step < n_steps)
        save_checkpoint();
    }
    write_results();
  }

  void Simulation::report_setup()
  {
    const unsigned int n_nodes = dam->structure.n_nodes();
    log.line("Mesh      %s: %zu cells, degree %u, %u dofs, %u monoliths; volume %.4g m3, crest %.1f m",
             scene.name.c_str(), dam->n_cells, scene.elements.degree, 3 * n_nodes, dam->n_monoliths,
             dam->volume, dam->crest_length);
    if (dam->tied)
      log.line("Joints    %u joints, tied: the monolithic dam", dam->n_joints);
    else
    {
      std::string laws = scene.joints.model;
      for (const auto &entry : scene.joints.overrides)
        laws += ", joint " + std::to_string(entry.first) + ": " + entry.second;
      log.line("Joints    %u joints, %zu pairs, law %s (friction %g)", dam->n_joints,
               dam->structure.pairs.size(), laws.c_str(), scene.joints.friction);
    }
    log.line("Damping   Rayleigh, C = %.4g 1/s M + %.4g s K: %.3g %% at %g Hz and %g Hz",
             scene.damping.mass_factor(), scene.damping.stiffness_factor(), 100. * scene.damping.ratio,
             scene.damping.frequency_1, scene.damping.frequency_2);
    if (!dam->has_water)
      log.line("Water     none: the reservoir is empty");
    else
      log.line("Water     level %g m; added mass %s x %g, %.4g kg along x", scene.reservoir.level,
               scene.reservoir.added_mass.c_str(), scene.reservoir.factor, dam->added_mass);
    if (options.validate)
    {
      double pairs = 0.;
      for (const Body &body : dam->structure.bodies)
        pairs += std::pow(3. * body.interface.size(), 2);
      double entries = 0.;
      for (const Body &body : dam->structure.bodies)
        entries += 9. * body.stiffness.value.size();
      log.line("Unknowns  %u of the bodies, %zu of the joints", 3 * n_nodes, 3 * dam->structure.pairs.size());
      if (dam->foundation)
        log.line("Steps     %u of %g s, %u of the rock in each; its critical time step is %.4g s", n_steps,
                 motion.dt, scene.foundation.substeps, dam->foundation->critical_time_step());
      else
        log.line("Steps     %u of %g s; the scheme is implicit: there is no critical time step", n_steps,
                 motion.dt);
      log.line("Memory    about %.1f GiB",
               (8. * (entries * 5. + pairs * 3.) + 1e3 * 27 * n_nodes) / std::pow(2., 30));
    }
  }

  /** Those of the scene; the problems of this @p stage go to a directory of their own. */
  ContactParameters Simulation::contact_parameters(const std::string &stage) const
  {
    ContactParameters parameters = scene.contact;
    parameters.write_directory = directory + "/contact/" + stage;
    if (parameters.write_problems)
      std::filesystem::create_directories(parameters.write_directory);
    return parameters;
  }

  void Simulation::find_static_state()
  {
    const Stopwatch   watch;
    const Structure  &structure = dam->structure;
    const std::size_t n_pairs = structure.pairs.size();
    Unknowns          springs;
    if (dam->foundation) // between dam and rock, for the static iteration only
    {
      springs = dam->foundation->static_springs(structure);
      dam->structure.dashpots = springs;
    }
    JointSystem system(structure, dam->laws, contact_parameters("static"), 0., 1., 1.);
    dam->structure.dashpots.clear();
    Unknowns gap(3 * n_pairs, 0.), start, offset(3 * n_pairs, 0.);
    statics.force.assign(3 * n_pairs, 0.);
    statics.u.assign(3 * structure.n_nodes(), 0.);
    unsigned int iterations = 0;
    for (unsigned int i = 1; i <= scene.statics.water_increments; ++i)
    {
      // slip is counted from the last increment
      start = gap;
      statics.load = dam->static_load(double(i) / scene.statics.water_increments);
      if (dam->foundation)
        settle(system, springs, start, gap);
      else
        statics.contact = system.solve(statics.load, offset, start, statics.force, gap, statics.u);
      iterations += statics.contact.iterations;
      if (!statics.contact.converged)
      {
        std::ostringstream message;
        message << "The static state did not converge in increment " << i
                << " of the water: relative residual " << statics.contact.residual << " after "
                << statics.contact.iterations
                << " Newton steps. More increments may help (entry \"Statics/Water increments\").";
        throw ComputationError(message.str());
      }
    }
    statics.contact.iterations = iterations;
    statics.pairs = system.states();
    statics.n_open = std::count(statics.pairs.begin(), statics.pairs.end(), PairState::open);
    if (const unsigned int e = dam->model->equation[dam->geometry->crown]; e != rigid_ground)
      statics.crown = {{statics.u[3 * e], statics.u[3 * e + 1], statics.u[3 * e + 2]}};
    count.seconds_static = watch.seconds();
    log.line("Static    self-weight %s, then water: %u Newton steps, %u pairs open, crest %.1f mm downstream "
             "(%.1f s)",
             scene.statics.self_weight.c_str(), iterations, statics.n_open, 1e3 * statics.crown[0],
             count.seconds_static);
  }

  /** The static state of dam and rock: the rock gives way under the forces of the dam, the dam follows
   * through stiff springs with the force that they carried before, so that they are without force in the end.
   * Anderson's acceleration of the displacements of the base (Walker and Ni 2011). */
  void Simulation::settle(JointSystem &system, const Unknowns &springs, const Unknowns &start, Unknowns &gap)
  {
    Foundation           &rock = *dam->foundation;
    const std::size_t     n = 3 * rock.feet().size();
    const Unknowns        external = statics.load, offset(gap.size(), 0.);
    Unknowns              base(n, 0.), r(external.size(), 0.), settled;
    std::vector<Unknowns> df, dx; // differences of residuals and of bases
    Unknowns              last_f, last_base;
    double                error = 1.;
    unsigned int          iterations = 0, round = 0;
    for (; round < 60 && error > 1e-9; ++round)
    {
      Unknowns load = external;
      for (std::size_t i = 0; i < n / 3; ++i)
        for (const unsigned int node : rock.feet()[i].nodes)
          for (unsigned int c = 0; c < 3; ++c)
            load[3 * node + c] += springs[3 * node + c] * base[3 * i + c] - r[3 * node + c];
      statics.contact = system.solve(load, offset, start, statics.force, gap, statics.u);
      iterations += statics.contact.iterations;
      if (!statics.contact.converged)
        break;
      double slack = 0., size = 1e-300;
      for (std::size_t i = 0; i < n / 3; ++i)
        for (const unsigned int node : rock.feet()[i].nodes)
          for (unsigned int c = 0; c < 3; ++c)
          {
            const double difference = statics.u[3 * node + c] - base[3 * i + c];
            r[3 * node + c] += springs[3 * node + c] * difference;
            slack = std::max(slack, std::abs(difference));
          }
      rock.settle(r, settled);
      Unknowns f = settled;
      for (std::size_t k = 0; k < n; ++k)
      {
        f[k] -= base[k];
        slack = std::max(slack, std::abs(f[k]));
        size = std::max(size, std::abs(settled[k]));
      }
      error = slack / size;
      if (round > 0)
      {
        df.push_back(f);
        dx.push_back(base);
        for (std::size_t k = 0; k < n; ++k)
        {
          df.back()[k] -= last_f[k];
          dx.back()[k] -= last_base[k];
        }
        if (df.size() > 25)
        {
          df.erase(df.begin());
          dx.erase(dx.begin());
        }
      }
      last_f = f;
      last_base = base;
      accelerate(df, dx, f, base);
    }
    statics.contact.iterations = iterations;
    if (error > 1e-9)
      throw ComputationError("The static state of dam and rock did not converge: relative error " +
                             std::to_string(error) + " after " + std::to_string(round) + " rounds.");
    for (std::size_t k = 0; k < r.size(); ++k)
      statics.load[k] -= r[k];
    log.line("Rock      %u nodes; static state of dam and rock after %u rounds", rock.n_nodes(), round);
  }

  void Simulation::start_shaking()
  {
    const Stopwatch  watch;
    const Structure &structure = dam->structure;
    if (dam->foundation && n_steps > 0)
    {
      dam->foundation->start(motion, motion.dt, n_steps, statics.u, dam->structure);
      if (const std::string warning = dam->foundation->warning(motion.dt); !warning.empty())
        log.line("warning: %s", warning.c_str());
    }
    newmark = std::make_unique<Newmark>(structure, dam->laws, contact_parameters("shaking"), motion.dt,
                                        impact_rule(scene.impact_rule));
    Unknowns load = statics.load;
    if (n_steps > 0)
      for (unsigned int d = 0; d < 3; ++d)
        for (std::size_t k = 0; k < load.size(); ++k)
          load[k] += motion.acceleration[0][d] * dam->inertia[d][k];
    newmark->start(statics.u, Unknowns(statics.u.size(), 0.), statics.force, load,
                   Unknowns(3 * structure.pairs.size(), 0.));

    joints = std::make_unique<JointRecorder>(structure, *dam->geometry);
    stress = std::make_unique<StressRecovery>(*dam->model, std::vector<Material>{scene.concrete},
                                              scene.elements.incompatible_modes);
    envelope = std::make_unique<EnvelopeRecorder>(*stress, dam->initial_stress);
    history.columns = {"time",
                       "crest_x",
                       "crest_y",
                       "crest_z",
                       "base_acceleration_x",
                       "base_acceleration_y",
                       "base_acceleration_z"};
    if (!dam->base_is_held())
      for (const char *name : {"base_x", "base_y", "base_z"})
        history.columns.push_back(name);
    probes = {dam->geometry->crown};
    for (const auto &probe : scene.output.probe_places())
    {
      const Vector3 &p = probe.second;
      probes.push_back(nearest_node(*dam->model, dealii::Point<3>(p[0], p[1], p[2])));
      for (const char *c : {"_x", "_y", "_z"})
        history.columns.push_back(probe.first + c);
    }
    energy.columns = {"time",     "kinetic", "strain", "added_mass", "damping",
                      "friction", "impact",  "input",  "balance"};
    if (dam->foundation && n_steps > 0)
      for (const char *name :
           {"rock_kinetic", "rock_strain", "rock_damping", "rock_feet", "transmitted", "rock_balance"})
        energy.columns.push_back(name);
    count.seconds_static += watch.seconds();
    if (n_steps > 0)
    {
      log.line("Shaking   %.2f s in %u steps of %g s; joints and factors hold %.2f GiB", n_steps * motion.dt,
               n_steps, motion.dt, newmark->joint_system().memory() / std::pow(2., 30));
      log.line("\n   time  newton  open  slip  opening [mm]  slip [mm]  tension [MPa]  elapsed     left");
    }
  }

  void Simulation::advance()
  {
    const Stopwatch watch;
    const double    rock_before = dam->foundation ? dam->foundation->seconds : 0.;
    Unknowns        load = statics.load;
    const auto     &a = motion.acceleration[step + 1];
    for (std::size_t k = 0; k < load.size(); ++k)
      load[k] += a[0] * dam->inertia[0][k] + a[1] * dam->inertia[1][k] + a[2] * dam->inertia[2][k];
    if (dam->foundation)
      dam->foundation->advance(newmark->state(), load);
    const SystemTimes   before = newmark->joint_system().times;
    const Vector3       base_velocity = dam->foundation ? dam->foundation->base_velocity() : Vector3{};
    const ContactResult result = newmark->advance(load, base_velocity);
    if (dam->foundation)
    {
      dam->foundation->follow(newmark->state());
      const RegionEnergy &rock = dam->foundation->energy();
      count.rock_energy = std::max(count.rock_energy, rock.kinetic + rock.strain);
      count.rock_imbalance = std::max(count.rock_imbalance, std::abs(rock.balance()));
    }
    ++count.path[static_cast<unsigned int>(result.path)];
    ++step;
    const double rock_seconds = dam->foundation ? dam->foundation->seconds - rock_before : 0.;
    count.seconds_rock += rock_seconds;
    const SystemTimes &after = newmark->joint_system().times;
    count.seconds_sweeps += after.sweeps - before.sweeps;
    count.seconds_joints += after.joints - before.joints;
    count.seconds_stepping +=
        watch.seconds() - (after.sweeps - before.sweeps) - (after.joints - before.joints) - rock_seconds;
    count.newton += result.iterations;
    count.newton_max = std::max<double>(count.newton_max, result.iterations);
    count.krylov += result.krylov;
    count.factorisations += result.factorisations;
    count.sweeps += result.sweeps;
    count.residual = std::max(count.residual, result.residual);
    count.energy_error = std::max(count.energy_error, newmark->energy_error());
  }

  void Simulation::record()
  {
    const DynamicState &state = newmark->state();
    if (scene.output.envelope_interval > 0 && step % scene.output.envelope_interval == 0)
    {
      const Stopwatch watch;
      envelope->record(state.time, state.u);
      count.seconds_stresses += watch.seconds();
    }
    const Stopwatch watch;
    joints->record(*newmark);
    if (const double jump = std::max(joints->opening.value, joints->slip.value); jump > .02 * dam->size)
    {
      std::ostringstream message;
      message
          << "The joints have moved by " << jump << " m at t = " << state.time
          << " s: the run has become unstable. Use \"Dynamics/Impact\" = mean-force, or a smaller time step.";
      write_tables();
      throw ComputationError(message.str());
    }
    std::vector<double> row = {state.time};
    for (std::size_t i = 0; i < probes.size(); ++i)
    {
      const Vector3 u = relative_to_base(probes[i]);
      row.insert(row.end(), u.begin(), u.end());
      if (i == 0)
        row.insert(row.end(), motion.acceleration[step].begin(), motion.acceleration[step].end());
      if (i == 0 && !dam->base_is_held())
      {
        const Vector3 base = dam->base_motion(state.u);
        row.insert(row.end(), base.begin(), base.end());
      }
    }
    history.rows.push_back(row);
    const Energy &e = state.energy, &e0 = newmark->initial_energy();
    energy.rows.push_back({state.time, e.kinetic, e.strain - e0.strain, e.added_mass, e.damping, e.friction,
                           e.impact, e.input, e.balance(e0)});
    if (dam->foundation && n_steps > 0)
    {
      const RegionEnergy &rock = dam->foundation->energy();
      for (const double value :
           {rock.kinetic, rock.strain, rock.damping, rock.prescribed, rock.transmitted, rock.balance()})
        energy.rows.back().push_back(value);
    }
    if (scene.output.solution_interval > 0 && step % scene.output.solution_interval == 0)
      write_solution();
    count.seconds_output += watch.seconds();
  }

  /** Displacement of a node against the base (on rock: against its lowest part), the static one included. */
  Vector3 Simulation::relative_to_base(const unsigned int node) const
  {
    const Unknowns    &u = newmark->state().u;
    const unsigned int e = dam->model->equation[node];
    Vector3            result{};
    if (e != rigid_ground)
      result = {{u[3 * e], u[3 * e + 1], u[3 * e + 2]}};
    return result - dam->base_motion(u);
  }

  void Simulation::report_step()
  {
    unsigned int open = 0, slip = 0;
    for (const PairState state : newmark->pair_states())
    {
      open += state == PairState::open;
      slip += state == PairState::slip;
    }
    const double done = step - first_step, elapsed = shaking_clock.seconds();
    const float  tension = *std::max_element(envelope->maximum.begin(), envelope->maximum.end());
    log.line("%7.2f  %6.2f %5u %5u  %12.2f %10.2f  %13.2f  %7s  %7s", newmark->state().time,
             count.newton / step, open, slip, 1e3 * joints->opening.value, 1e3 * joints->slip.value,
             scene.output.envelope_interval > 0 ? 1e-6 * tension : 0.,
             clock_time(clock_before + elapsed).c_str(),
             clock_time(elapsed / done * (n_steps - step)).c_str());
  }
} // namespace Voussoir
