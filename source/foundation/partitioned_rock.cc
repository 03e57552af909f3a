// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/foundation/partitioned_rock.h>

#include <sstream>

namespace Voussoir
{
  void PartitionedRock::add_mass(Structure &structure) const
  {
    for (const BaseNode &base_node : at_base)
      for (const unsigned int node : base_node.nodes)
        for (unsigned int c = 0; c < 3; ++c)
          structure.mass[node][4 * c] += model.mass[base_node.rock] / base_node.nodes.size();
  }

  std::string PartitionedRock::about_steps() const
  {
    std::ostringstream text;
    text.precision(4);
    text << ", " << parameters.n_substeps()
         << (parameters.n_substeps() == 1 ? " rock step each" : " rock steps each")
         << "; critical time step of the rock " << dt_critical << " s";
    return text.str();
  }

  void PartitionedRock::start(const GroundMotion &outcrop, const TimeGrid &steps, const Unknowns &u)
  {
    make_rock(outcrop, steps, 0., {});
    region->set_prescribed(rock_nodes(at_base));
    const std::size_t n = 3 * at_base.size();
    rest.assign(n, 0.);
    for (std::size_t i = 0; i < at_base.size(); ++i)
      for (const unsigned int node : at_base[i].nodes)
        for (unsigned int c = 0; c < 3; ++c)
          rest[3 * i + c] += u[3 * node + c] / at_base[i].nodes.size();
    v.assign(n, 0.);
    a = u_base = u_predicted = v_predicted = force = force_before = v;
  }

  void PartitionedRock::advance(Unknowns &load)
  {
    const Stopwatch watch;
    const double    worked = Ranks::work();
    const double    dt = grid.dt;
    Unknowns        u = u_predicted, v_now = v_predicted;
    for (std::size_t i = 0; i < at_base.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t k = 3 * i + c;
        u_predicted[k] = u_base[k] + dt * v[k] + .25 * dt * dt * a[k];
        v_predicted[k] = v[k] + .5 * dt * a[k];
        u[k] += u_predicted[k] - u[k]; // the sum, whose rounding all results have
        v_now[k] += v_predicted[k] - v_now[k];
      }
    const Unknowns &taken = region->advance(u, v_now);
    force_before.swap(force);
    for (std::size_t i = 0; i < at_base.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
      {
        // The dam applies the mass-proportional damping of the rock mass at the base.
        const std::size_t k = 3 * i + c;
        force[k] = parameters.mass_damping * model.mass[at_base[i].rock] * v_predicted[k] - taken[k];
        for (const unsigned int node : at_base[i].nodes)
          load[3 * node + c] += force[k] / at_base[i].nodes.size();
      }
    seconds_advancing += watch.seconds();
    work_advancing += Ranks::work() - worked;
  }

  void PartitionedRock::update_from_dam(const DynamicState &state)
  {
    for (std::size_t i = 0; i < at_base.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
      {
        const std::size_t k = 3 * i + c;
        const double      part = 1. / at_base[i].nodes.size();
        double            u_new = 0., v_new = 0.;
        for (const unsigned int node : at_base[i].nodes)
        {
          u_new += part * state.u[3 * node + c];
          v_new += part * state.v[3 * node + c];
        }
        u_new -= rest[k];
        balance->entries[RockBalance::on_dam] += .5 * (force_before[k] + force[k]) * (u_new - u_base[k]);
        u_base[k] = u_new;
        a[k] = 2. / grid.dt * (v_new - v[k]) - a[k];
        v[k] = v_new;
      }
    finish_step(state.time);
  }

  Vector3 PartitionedRock::base_velocity() const
  {
    Vector3 result{};
    for (std::size_t i = 0; i < at_base.size(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
        result[c] += v_predicted[3 * i + c] / at_base.size();
    return result;
  }

  void CommonStepRock::add_forces(Unknowns &load) const
  {
    for (std::size_t i = 0; i < at_base.size(); ++i)
      for (const unsigned int node : at_base[i].nodes)
        for (unsigned int c = 0; c < 3; ++c)
          load[3 * node + c] += force[3 * i + c] / at_base[i].nodes.size();
  }

  void CommonStepRock::advance(const Unknowns &u, const Unknowns &w)
  {
    const Stopwatch watch;
    Unknowns        v_before = v;
    v.assign(v.size(), 0.);
    u_base = v;
    for (std::size_t i = 0; i < at_base.size(); ++i)
      for (const unsigned int node : at_base[i].nodes)
        for (unsigned int c = 0; c < 3; ++c)
        {
          u_base[3 * i + c] += u[3 * node + c] / at_base[i].nodes.size();
          v[3 * i + c] += w[3 * node + c] / at_base[i].nodes.size();
        }
    for (std::size_t k = 0; k < v.size(); ++k)
    {
      u_base[k] -= rest[k];
      balance->entries[RockBalance::on_dam] += force[k] * .5 * grid.substep() * (v_before[k] + v[k]);
    }
    const Unknowns &taken = region->advance(u_base, v);
    for (std::size_t k = 0; k < v.size(); ++k)
      force[k] = -taken[k];
    seconds_advancing += watch.seconds();
  }

  std::vector<std::vector<double> *> PartitionedRock::state()
  {
    if (!region)
      return {};
    std::vector<std::vector<double> *> arrays = region->state();
    for (Unknowns *array : {&rest, &u_base, &v, &a, &u_predicted, &v_predicted, &force, &balance->entries})
      arrays.push_back(array);
    return arrays;
  }
} // namespace Voussoir
