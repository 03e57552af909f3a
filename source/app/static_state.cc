// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/simulation.h>
#include <voussoir/base/error.h>
#include <voussoir/contact/free_law.h>
#include <voussoir/dam/joint_water.h>
#include <voussoir/dam/static_path.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    constexpr double usual_gap = 5e-3; // of joints that are not grouted [m]

    /** The pairs between two heights are grouted where they are: their gap counts from there. */
    void close_pairs(const Structure &structure, const double from, const double to, const Unknowns &u,
                     Unknowns &closed, Unknowns &gap)
    {
      for (std::size_t p = 0; p < structure.pairs.size(); ++p)
        if (const double z = structure.pairs[p].place[2]; z > from && z <= to)
        {
          set(closed, p, structure.jump(structure.pairs[p], u));
          set(gap, p, {});
        }
    }
  } // namespace

  /** One step of the static history. Where open joints are wet, it is solved again until the water has gone
   * as far as it goes. */
  ContactResult Simulation::static_step(const StaticPath &path, const unsigned int i, JointSystem &system,
                                        JointWater *water, const Unknowns &springs, Unknowns &gap)
  {
    const Unknowns start = gap; // slip is counted from the last step
    Unknowns       offset = statics.closed;
    for (double &x : offset)
      x = -x;
    const Unknowns committed = statics.memory;
    const auto     solve = [&](const Unknowns &load)
    {
      stop_if_asked();
      statics.memory = committed; // the events of rounds before the last are none
      return system.solve(load, offset, start, statics.memory, statics.force, gap, statics.u);
    };
    const auto pressure = [&](const double z) // a joint that is not grouted has no faces that it could part
    { return z > path.part(i).grouted ? 0. : scene.loads.factor("uplift") * path.water_pressure(i, z); };
    ContactResult total;
    total.converged = true;
    do
    {
      statics.load = path.load(i);
      if (water != nullptr)
        water->add_forces(pressure, statics.load);
      const ContactResult result = dam->foundation->settle(solve, springs, statics.u, statics.load, log);
      total += result;
      if (!result.converged)
      {
        std::ostringstream message;
        message << "The static state did not converge in step " << i + 1 << " of " << path.n_steps()
                << ": relative residual " << result.residual << " after " << result.iterations
                << " Newton steps. More increments may help (entry \"Statics/Water increments\").";
        throw ComputationError(message.str());
      }
    } while (water != nullptr && water->spread(system.states(), pressure));
    system.commit(start, statics.force, gap, statics.memory);
    return total;
  }

  void Simulation::find_static_state()
  {
    const Stopwatch  watch;
    const Structure &structure = dam->structure;
    const Unknowns   springs = dam->foundation->static_springs(structure);
    const auto       feet = dam->foundation->static_feet(dam->structure);
    const StaticPath path(*dam);
    const auto       free = make_free_law();
    statics.force.assign(3 * structure.pairs.size(), 0.);
    statics.closed = statics.force;
    Unknowns gap = statics.force;
    statics.u.assign(3 * structure.n_nodes(), 0.);
    statics.memory = dam->laws.initial_memory();
    statics.contact.converged = true;
    std::unique_ptr<JointWater> water;
    if (scene.loads.uplift.joints && scene.loads.factor("uplift") != 0. && scene.reservoir.density > 0.)
      water = std::make_unique<JointWater>(*dam->model, structure);
    std::unique_ptr<JointSystem> system;
    ContactParameters            parameters = contact_parameters("static");
    for (unsigned int i = 0; i < path.n_steps(); ++i)
    {
      stop_if_asked();
      const double grouted = path.part(i).grouted, before = i == 0 ? -INFINITY : path.part(i - 1).grouted;
      if (i == 0 || grouted > before)
      {
        close_pairs(structure, before, grouted, statics.u, statics.closed, gap);
        parameters.write_problems = scene.contact.write_problems && grouted == INFINITY;
        system = std::make_unique<JointSystem>(structure, laws_up_to(grouted, *dam, *free), parameters, 0.,
                                               1., 0., ForceMeaning(), springs, feet.get());
      }
      statics.contact += static_step(path, i, *system, water.get(), springs, gap);
      record_static_step(path, i, *system, water.get(), gap);
    }
    if (water)
      statics.joint_water = water->pressures(
          [&](const double z)
          { return scene.loads.factor("uplift") * path.water_pressure(path.n_steps() - 1, z); });
    statics.pairs = system->states();
    pairs_at_start = statics.pairs;
    statics.n_open = std::count(statics.pairs.begin(), statics.pairs.end(), PairState::open);
    check_static_state(*dam, statics.u, statics.crown);
    count.seconds_static = watch.seconds();
    log.line(
        "Static    self-weight %s, then water: %u Newton steps, %u pair%s open, crest %.1f mm downstream%s "
        "(%.1f s)",
        scene.statics.self_weight.c_str(), statics.contact.iterations, statics.n_open,
        statics.n_open == 1 ? "" : "s", 1e3 * statics.crown[0], dam->base_is_held() ? "" : " of the base",
        count.seconds_static);
  }

  /** A row of stages.csv, and a line of the log at the end of each stage. */
  void Simulation::record_static_step(const StaticPath &path, const unsigned int i, const JointSystem &system,
                                      const JointWater *water, const Unknowns &gap)
  {
    const Structure   &structure = dam->structure;
    const StaticPart  &part = path.part(i);
    const unsigned int crown = dam->model->equation[dam->geometry->crown];
    if (crown != rigid_ground)
      statics.crown = Vector3{{statics.u[3 * crown], statics.u[3 * crown + 1], statics.u[3 * crown + 2]}} -
                      dam->base_motion(statics.u);
    double opening = 0., overlap = 0.; // the latter of faces that nothing holds apart yet
    for (std::size_t p = 0; p < structure.pairs.size(); ++p)
      if (structure.pairs[p].place[2] <= part.grouted)
        opening = std::max(opening, gap[3 * p]);
      else
        overlap = std::max(overlap, -structure.jump(structure.pairs[p], statics.u)[0]);
    const auto n_of = [&](const PairState state)
    { return double(std::count(system.states().begin(), system.states().end(), state)); };
    const double n_wet = water == nullptr ? 0. : water->n_wet();
    stages.columns = {"stage",      "share",      "level",     "crest_x",     "crest_y",    "crest_z",
                      "open_pairs", "slip_pairs", "wet_pairs", "max_opening", "max_overlap"};
    stages.rows.push_back({double(path.number(i)), path.share(i), part.level, statics.crown[0],
                           statics.crown[1], statics.crown[2], n_of(PairState::open), n_of(PairState::slip),
                           n_wet, opening, overlap});
    if (path.ends_part(i) && (path.n_parts() > 1 || n_wet > 0.))
      log.line("Stage     %s: crest %.1f mm downstream, %.0f pairs open, %.0f wet, largest opening %.2f mm",
               part.name.c_str(), 1e3 * statics.crown[0], n_of(PairState::open), n_wet, 1e3 * opening);
    if (path.ends_part(i) && overlap > usual_gap)
      log.line(
          "warning: stage %s: joints above the lift of %g m overlap by %.1f mm, since what is not grouted "
          "does not touch in this program. Beyond a joint's gap of a few millimetres that is no state of a "
          "dam: grout higher before (Statics/Stages).",
          part.name.c_str(), part.grouted, 1e3 * overlap);
  }
} // namespace Voussoir
