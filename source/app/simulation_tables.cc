// SPDX-License-Identifier: GPL-3.0-or-later
// What the columns of history.csv and energy.csv are.

#include <voussoir/app/simulation.h>

namespace Voussoir
{
  void Simulation::declare_tables()
  {
    history_columns = std::make_unique<Recorder>(history);
    energy_columns = std::make_unique<Recorder>(energy);
    declare_history(*history_columns);
    declare_energy(*energy_columns);
    if (scene.output.block_forces)
    {
      blocks = std::make_unique<BlockRecorder>(*dam, statics.joint_water);
      blocks->follow({statics.u, statics.u, {}, statics.force});
    }
  }

  void Simulation::declare_history(Recorder &table)
  {
    table.add("time", [this] { return newmark->state().time; });
    table.add_vector("crest", [this] { return relative_to_base(dam->geometry->crown); });
    const DamGeometry &geometry = *dam->geometry;
    if (dam->model->equation[geometry.crown_left] != dam->model->equation[geometry.crown])
      table.add_vector("crest_left", [this] { return relative_to_base(dam->geometry->crown_left); });
    table.add_vector("base_acceleration", [this] { return motion.sample(step); });
    if (!dam->base_is_held())
      table.add_vector("base", [this] { return dam->base_motion(newmark->state().u); });
    for (const auto &probe : scene.output.probe_places())
    {
      const Vector3     &p = probe.second;
      const unsigned int node = probe_node(*dam->model, probe.first, dealii::Point<3>(p[0], p[1], p[2]));
      table.add_vector(probe.first, [this, node] { return relative_to_base(node); });
    }
  }

  void Simulation::declare_energy(Recorder &table)
  {
    const auto now = [this]() -> const Energy & { return newmark->state().energy; };
    const auto first = [this]() -> const Energy & { return newmark->initial_energy(); };
    table.add("time", [this] { return newmark->state().time; });
    table.add("kinetic", [=] { return now().kinetic; });
    table.add("strain", [=] { return now().strain - first().strain; });
    table.add("added_mass", [=] { return now().added_mass; });
    table.add("damping", [=] { return now().damping; });
    table.add("friction", [=] { return now().friction; });
    table.add("impact", [=] { return now().impact; });
    table.add("input", [=] { return now().input; });
    table.add("balance", [=] { return now().balance(first()); });
    const auto stored = [=] { return now().joint_stored - first().joint_stored; };
    const auto fracture = [=] { return now().joint_fracture - first().joint_fracture; };
    if (dam->laws.have_seats())
      table.add("joint_stored", stored);
    if (dam->laws.have_bonds())
      table.add("joint_fracture", fracture);
    if (dam->laws.have_memory())
      table.add("bond",
                [=] { return stored() + fracture(); }); // the name of earlier versions, for one release
    table.add_named([this] { return dam->foundation->energies(); });
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
} // namespace Voussoir
