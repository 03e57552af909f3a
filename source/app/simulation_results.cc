// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/simulation.h>
#include <voussoir/output/energy_check.h>
#include <voussoir/output/figures.h>
#include <voussoir/output/joint_surfaces.h>
#include <voussoir/output/spectrum_table.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace Voussoir
{
  namespace
  {
    Table stages_table(const std::vector<StaticStep> &steps)
    {
      Table table;
      table.columns = {"stage",      "share",      "level",     "crest_x",     "crest_y",    "crest_z",
                       "open_pairs", "slip_pairs", "wet_pairs", "max_opening", "max_overlap"};
      for (const StaticStep &s : steps)
        table.rows.push_back({double(s.stage), s.share, s.level, s.crown[0], s.crown[1], s.crown[2],
                              double(s.n_open), double(s.n_slip), double(s.n_wet), s.opening, s.overlap});
      return table;
    }

    std::string joints_beside(const std::string &solution) // solution-NNNNN.vtu
    {
      return "joints" + solution.substr(8);
    }

    /** solution.pvd: the dam, and its joints beside it, at all times so far. */
    void write_collection(const std::string                                 &directory,
                          const std::vector<std::pair<double, std::string>> &solutions, const bool has_joints)
    {
      OutputFile pvd(directory + "/solution.pvd");
      const auto add = [&](const double time, const std::string &file, const int part)
      { pvd << "<DataSet timestep=\"" << time << "\" file=\"" << file << "\" part=\"" << part << "\"/>\n"; };
      pvd << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
      for (const auto &[time, file] : solutions)
      {
        add(time, file, 0);
        if (has_joints)
          add(time, joints_beside(file), 1);
      }
      pvd << "</Collection>\n</VTKFile>\n";
      pvd.check();
    }
  } // namespace

  void Simulation::write_solution()
  {
    std::vector<Stress> s;
    stress->apply(newmark->state().u, known_tractions(), s);
    std::vector<FieldWriter::NodalField> fields = {{"max_principal", std::vector<float>(s.size())},
                                                   {"min_principal", std::vector<float>(s.size())}};
    constexpr const char                *components[6] = {"xx", "yy", "zz", "xy", "yz", "zx"};
    for (unsigned int c = 0; c < 6; ++c)
      fields.push_back({std::string("stress_") + components[c], std::vector<float>(s.size())});
    for (std::size_t i = 0; i < s.size(); ++i)
    {
      for (unsigned int c = 0; c < 6; ++c)
        fields[2 + c].values[i] = s[i][c] += dam->initial_stress[i][c];
      const auto p = principal_stresses(s[i]);
      fields[0].values[i] = p[0];
      fields[1].values[i] = p[1];
    }
    // Joint state at the nodes of the joints: opening, slip, and 0 open, 1 stick, 2 slip; 0, 0 and -1
    // elsewhere (not nan, which deal.II would spread over the cells).
    const std::vector<PairState> &pairs = step == start_step ? pairs_at_start : newmark->pair_states();
    std::vector<float> opening(dam->structure.n_nodes(), 0.f), slip(opening), state(opening.size(), -1.f),
        pressure(opening);
    for (unsigned int p = 0; p < dam->structure.pairs.size(); ++p)
    {
      const Vector3 d = newmark->opening_and_slip(p);
      for (const unsigned int node : {dam->structure.pairs[p].node_1, dam->structure.pairs[p].node_2})
        if (node != rigid_ground)
        {
          opening[node] = d[0];
          slip[node] = std::hypot(d[1], d[2]);
          pressure[node] = joint_pressure(dam->structure, newmark->state(), p);
          state[node] = static_cast<float>(pairs[p]);
        }
    }
    for (const auto &field : {std::make_pair("opening", &opening),
                              {"slip", &slip},
                              {"joint_pressure", &pressure},
                              {"joint_state", &state}})
    {
      fields.push_back({field.first, std::vector<float>(s.size(), field.second == &state ? -1.f : 0.f)});
      for (std::size_t i = 0; i < s.size(); ++i)
        if (dam->model->equation[i] != rigid_ground)
          fields.back().values[i] = (*field.second)[dam->model->equation[i]];
    }
    char name[40];
    std::snprintf(name, sizeof(name), "solution-%05u.vtu", step);
    FieldWriter(*dam->model).write_vtu(directory + "/" + name, newmark->state().u, fields);
    solutions.emplace_back(newmark->state().time, name);
    const bool has_joints = !dam->structure.pairs.empty();
    if (has_joints)
      write_joint_surfaces(directory + "/" + joints_beside(name), *dam->model, dam->structure, *newmark,
                           pairs);
    write_collection(directory, solutions, has_joints);
  }

  void Simulation::open_tables()
  {
    history_file.open(directory + "/history.csv", history);
    energy_file.open(directory + "/energy.csv", energy);
    joint_file.open(directory + "/joint_history.csv", joints->history);
    if (blocks)
      block_file.open(directory + "/blocks.csv", blocks->history);
    if (n_steps > 0)
    {
      MotionParameters as_run = scene.motion;
      as_run.factor *= scene.loads.factor("earthquake"); // of the combination, as that of the motion
      spectrum_table(motion, as_run).write(directory + "/spectrum.csv");
    }
    if (!scene.statics.stages.empty())
      stages_table(statics.steps).write(directory + "/stages.csv");
  }

  void Simulation::write_tables()
  {
    history_file.append(history);
    energy_file.append(energy);
    joint_file.append(joints->history);
    if (blocks)
      block_file.append(blocks->history);
    joints->maxima().write(directory + "/joints.csv");
    if (!dam->structure.pairs.empty())
      joints->points.write(directory, *dam->geometry);
    joints->pressures().write(directory + "/joint_pressures.csv");
  }

  void Simulation::write_fields()
  {
    const Stopwatch watch;
    if (scene.output.envelope_interval > 0)
    {
      const FieldWriter writer(*dam->model);
      writer.write_vtu(directory + "/envelope.vtu", {},
                       {{"max_principal", envelope->maximum},
                        {"min_principal", envelope->minimum},
                        {"max_joint_pressure", joints->largest_pressure(*dam->model)}});
      writer.write_faces(directory, *dam->geometry, envelope->maximum, envelope->minimum);
    }
    count.seconds_output += watch.seconds();
  }

  void Simulation::write_results()
  {
    write_tables();
    write_fields();
    for (const std::string &warning : joints->reach.warnings())
      log.line("warning: %s", warning.c_str());
    if (const auto [missing, joint] = joints->points.height_without_waterstop();
        joints->points.has_waterstops() && missing > 0. &&
        (scene.limits.waterstop_opening > 0. || scene.limits.waterstop_slip > 0.))
      log.line("warning: joint %u is thinner than Limits/Waterstop depth, %g m, over the highest %.1f m: "
               "openings and "
               "slips there are not held against the limits of the waterstops. Take a smaller depth.",
               joint, scene.limits.waterstop_depth, missing);
    write_summary();
    log.line("Joints    largest opening %.2f mm, largest slip %.2f mm", 1e3 * joints->opening.value,
             1e3 * joints->slip.value);
    if (companion)
    {
      const TimeError error = companion->of(*joints, *envelope, *tension);
      if (!dam->structure.pairs.empty())
        log.line("          error by the time step, by estimate: %.2g %% of the joints' openings; %.2g mm of "
                 "the largest",
                 100. * error.opening, 1e3 * error.largest_opening);
      if (std::isfinite(error.tension_upstream))
        log.line("          error by the time step, by estimate: %.2g and %.2g MPa of the largest tension "
                 "upstream and downstream",
                 1e-6 * error.tension_upstream, 1e-6 * error.tension_downstream);
    }
    report_tension();
    if (n_steps > 0)
      log.line("Speed     %.2f s of wall time per second of shaking; per step %.1f ms: substitutions %.1f, "
               "joints %.1f, stepping %.1f, stresses %.1f, output %.1f",
               count.seconds_shaking / grid().duration(), 1e3 * count.seconds_shaking / n_steps,
               1e3 * count.seconds_substitutions / n_steps, 1e3 * count.seconds_joints / n_steps,
               1e3 * count.seconds_stepping / n_steps, 1e3 * count.seconds_stresses / n_steps,
               1e3 * count.seconds_output / n_steps);
    log.line("Energy    balance closes to %.1e of the largest energy", balance_error());
    dam->foundation->report_balance(log);
    std::error_code ignored;
    for (const char *ending : {"", ".before", ".new"})
      std::filesystem::remove(checkpoint_name() + ending, ignored); // the run is complete: nothing to resume
    std::filesystem::remove(directory + "/checkpoint.txt", ignored);
    if (scene.output.figures)
      draw_figures();
    log.line("Results   %s", directory.c_str());
  }

  /** The largest tensions that are not those of the singular base, and these apart. */
  void Simulation::report_tension()
  {
    if (scene.output.envelope_interval == 0)
      return;
    const auto in_words = [&](const int surface, const bool base) -> std::string
    {
      const Extreme largest = base ? envelope->extreme(*dam->model, surface, true)
                                   : tension->largest_away_from_base(*envelope, *dam->model, surface);
      char          text[40];
      std::snprintf(text, sizeof(text), "%.2f MPa", 1e-6 * largest.value);
      return std::isfinite(largest.value) ? text : "none";
    };
    log.line(
        "Tension   largest %s upstream, %s downstream, farther than a tenth of the height from the base; "
        "with the base, where it grows with refinement, %s and %s",
        in_words(PhysicalId::upstream, false).c_str(), in_words(PhysicalId::downstream, false).c_str(),
        in_words(PhysicalId::upstream, true).c_str(), in_words(PhysicalId::downstream, true).c_str());
    if (const double f = scene.strength_of_area(); f > 0.)
      log.line(
          "          above the strength of %.2f MPa: %.1f %% of the upstream face, %.1f %% of the downstream "
          "face",
          1e-6 * f, 100. * tension->above(*envelope, PhysicalId::upstream, f).share(),
          100. * tension->above(*envelope, PhysicalId::downstream, f).share());
  }

  double Simulation::largest_energy() const
  {
    // Before the motion has begun there is only the round-off of the static state.
    return std::max(newmark->largest_energy(), 1e-6 * std::abs(newmark->initial_energy().strain));
  }

  double Simulation::balance_error() const
  {
    return count.imbalance / std::max(largest_energy(), 1e-300);
  }

  void Simulation::check_balance() const
  {
    if (n_steps > 0)
      check_energies(scene, balance_error(), dam->foundation->balance_error(), directory);
  }

  void Simulation::draw_figures()
  {
    const std::string error = draw_figures_of(directory, directory + "/figures.log");
    if (error.empty())
      log.line("Figures   %s/figures", directory.c_str());
    else
      log.line("warning: the figures could not be drawn: %s. The results are complete.", error.c_str());
  }
} // namespace Voussoir
