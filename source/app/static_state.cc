// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/simulation.h>
#include <voussoir/base/error.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Voussoir
{
  void Simulation::find_static_state()
  {
    const Stopwatch   watch;
    const Structure  &structure = dam->structure;
    const std::size_t n_pairs = structure.pairs.size();
    const Unknowns    springs = dam->foundation->static_springs(structure);
    JointSystem       system(structure, dam->laws, contact_parameters("static"), 0., 1., 0., ForceMeaning(),
                             springs);
    Unknowns          gap(3 * n_pairs, 0.), start, offset(3 * n_pairs, 0.);
    statics.force.assign(3 * n_pairs, 0.);
    statics.u.assign(3 * structure.n_nodes(), 0.);
    statics.memory = dam->laws.initial_memory();
    ContactResult total;
    total.converged = true;
    for (unsigned int i = 1; i <= scene.statics.water_increments; ++i)
    {
      // slip is counted from the last increment
      stop_if_asked();
      start = gap;
      statics.load = dam->static_load(double(i) / scene.statics.water_increments);
      const Unknowns committed = statics.memory;
      const auto     solve = [&](const Unknowns &load)
      {
        stop_if_asked();
        statics.memory = committed; // the events of rounds before the last are none
        return system.solve(load, offset, start, statics.memory, statics.force, gap, statics.u);
      };
      statics.contact = dam->foundation->settle(solve, springs, statics.u, statics.load, log);
      total += statics.contact;
      if (!statics.contact.converged)
      {
        std::ostringstream message;
        message << "The static state did not converge in increment " << i
                << " of the water: relative residual " << statics.contact.residual << " after "
                << statics.contact.iterations
                << " Newton steps. More increments may help (entry \"Statics/Water increments\").";
        throw ComputationError(message.str());
      }
      system.commit(start, statics.force, gap, statics.memory);
    }
    statics.contact = total;
    statics.pairs = system.states();
    pairs_at_start = statics.pairs;
    statics.n_open = std::count(statics.pairs.begin(), statics.pairs.end(), PairState::open);
    if (const unsigned int e = dam->model->equation[dam->geometry->crown]; e != rigid_ground)
      statics.crown = Vector3{{statics.u[3 * e], statics.u[3 * e + 1], statics.u[3 * e + 2]}} -
                      dam->base_motion(statics.u);
    check_static_state(*dam, statics.u, statics.crown);
    count.seconds_static = watch.seconds();
    log.line(
        "Static    self-weight %s, then water: %u Newton steps, %u pairs open, crest %.1f mm downstream%s "
        "(%.1f s)",
        scene.statics.self_weight.c_str(), total.iterations, statics.n_open, 1e3 * statics.crown[0],
        dam->base_is_held() ? "" : " of the base", count.seconds_static);
  }
} // namespace Voussoir
