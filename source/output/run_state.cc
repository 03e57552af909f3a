// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/dynamics/integrator_table.h>
#include <voussoir/output/run_state.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    void add_inertia(const Dam &dam, const Vector3 &a, Unknowns &load)
    {
      for (std::size_t k = 0; dam.foundation->moves_base() && k < load.size(); ++k)
        load[k] += a[0] * dam.inertia[0][k] + a[1] * dam.inertia[1][k] + a[2] * dam.inertia[2][k];
    }

    /** Adds the changes of the forces with a history since the static state. */
    void add_changes(const Dam &dam, const double time, Unknowns &load)
    {
      for (const ForceInTime &force : dam.forces)
        for (std::size_t k = 0; k < load.size(); ++k)
          load[k] += (force.at(time) - force.value.front()) * force.pattern[k];
    }
  } // namespace

  void RunState::start(const ContactParameters &parameters)
  {
    if (const UpliftParameters &uplift = scene().loads.uplift;
        n_steps > 0 && uplift.acts() && uplift.in_earthquake != "unchanged")
    {
      crack_water = std::make_unique<CrackWater>(*dam, statics);
      dam->neighbours.push_back(crack_water.get());
    }
    if (n_steps > 0)
      for (Neighbour *neighbour : dam->neighbours)
        neighbour->start(motion, grid(), statics.u);
    Support *const               support = n_steps > 0 ? dam->foundation->support(dam->structure) : nullptr;
    std::vector<StepNeighbour *> explicit_neighbours;
    if (n_steps > 0 && scene().is_explicit())
    {
      if (StepNeighbour *const of_base = dam->foundation->step_neighbour(dam->structure))
        explicit_neighbours.push_back(of_base);
      if (dam->water)
        explicit_neighbours.push_back(dam->water.get());
    }
    integrator = make_integrator(n_steps > 0 ? scene().scheme : "trapezoidal",
                                 {dam->structure, dam->layout.laws, parameters, motion.dt,
                                  impact_rule(scene().impact_rule), support, scene().has_single_factors(),
                                  scene().n_explicit, explicit_neighbours});
    Unknowns load = statics.constant_load();
    if (n_steps > 0)
    {
      add_inertia(*dam, motion.acceleration[0], load);
      add_changes(*dam, 0., load);
    }
    integrator->start(statics.u, dam->initial_velocity(), statics.force, load, statics.closed, statics.memory,
                      statics.modulus_force);
  }

  Unknowns RunState::next_load() const
  {
    Unknowns load = statics.constant_load();
    add_inertia(*dam, motion.sample(step + 1), load);
    add_changes(*dam, (step + 1) * motion.dt, load);
    return load;
  }

  unsigned int RunState::end_of_part(const std::size_t part) const
  {
    const double time = motion.end_of_rest(part) + dam->foundation->delay();
    return part + 1 < motion.parts.size()
               ? std::min(n_steps, static_cast<unsigned int>(std::lround(time / motion.dt)))
               : n_steps;
  }

  Vector3 RunState::ground_acceleration(const unsigned int after) const
  {
    return dam->foundation->moves_base() ? motion.acceleration[after] : Vector3{};
  }

  Vector3 RunState::relative_to_base(const unsigned int node) const
  {
    const Unknowns    &u = integrator->state().u;
    const unsigned int e = dam->model->equation[node];
    Vector3            result{};
    if (e != rigid_ground)
      result = {{u[3 * e], u[3 * e + 1], u[3 * e + 2]}};
    return result - dam->base_motion(u);
  }

  Vector3 RunState::velocity_relative_to_base(const unsigned int node) const
  {
    const Unknowns    &v = integrator->state().v;
    const unsigned int e = dam->model->equation[node];
    return (e == rigid_ground ? Vector3{} : get(v, e)) - dam->base_motion(v);
  }

  Vector3 RunState::absolute_acceleration(const unsigned int node) const
  {
    if (step == 0)
      return {};
    if (const unsigned int e = dam->model->equation[node]; e != rigid_ground)
      return get(acceleration, e);
    const Vector3 before = ground_acceleration(step - 1), after = ground_acceleration(step);
    return {{.5 * (before[0] + after[0]), .5 * (before[1] + after[1]), .5 * (before[2] + after[2])}};
  }

  void RunState::with_last_step(const std::function<void(const StepOfDam &)> &use) const
  {
    if (step == 0)
    {
      const Unknowns u = statics.elastic(statics.u);
      return use({u, u, {}, statics.force});
    }
    const DynamicState &state = integrator->state();
    const Vector3       first = ground_acceleration(step - 1), last = ground_acceleration(step);
    const double        weight = integrator->weight_of_end();
    Vector3             velocity, ground;
    for (unsigned int c = 0; c < 3; ++c)
    {
      velocity[c] = .5 * (base_velocity_before[c] + state.base_velocity[c]);
      ground[c] = (1. - weight) * first[c] + weight * last[c];
    }
    Unknowns force = integrator->impulses();
    for (double &f : force)
      f /= motion.dt;
    use({statics.elastic(u_before), statics.elastic(state.u), acceleration, force, ground, velocity,
         motion.dt, dam->water ? dam->water->mean_force() : std::vector<Vector3>(), state.relaxation.mean,
         state.relaxation.lag});
  }

  double RunState::largest_energy() const
  {
    // Before the motion begins, the largest energy is only round-off of the static state.
    return std::max(integrator->largest_energy(), 1e-6 * std::abs(integrator->initial_energy().strain));
  }
} // namespace Voussoir
