// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/number_text.h>
#include <voussoir/output/archive.h>
#include <voussoir/output/observers.h>

#include <cmath>

namespace Voussoir
{
  HistoryObserver::HistoryObserver(const RunState &run) : run(run)
  {
    declare_history();
    declare_energy();
  }

  void HistoryObserver::declare_history()
  {
    TableColumns      &table = history_columns;
    const DamGeometry &geometry = *run.dam->geometry;
    const SolidModel  &model = *run.dam->model;
    crown_is_at_joint = model.equation[geometry.crown_left] != model.equation[geometry.crown];
    table.add("time", [this] { return run.integrator->state().time; });
    declare_point("crest", {{}, 0, {{geometry.crown, 1.}}});
    if (crown_is_at_joint)
      declare_point("crest_left", {{}, 0, {{geometry.crown_left, 1.}}});
    table.add_vector("base_acceleration", [this] { return run.motion.sample(run.step); });
    if (!run.dam->base_is_held())
      table.add_vector("base", [this] { return run.dam->base_motion(run.integrator->state().u); });
    for (const auto &probe : run.scene().output.probe_places())
      declare_point(probe.first, probe_place(model, probe.first, probe.second));
    declare_accelerations();
    for (std::size_t k = crown_is_at_joint ? 2 : 1; k < points.size(); ++k)
      history_columns.add_vector(points[k] + "_velocity",
                                 [this, k]
                                 {
                                   return places[k].interpolated(
                                       [this](const unsigned int node)
                                       { return run.velocity_relative_to_base(node); });
                                 });
    for (const double depth : run.scene().output.pressure_depths)
      if (const AcousticWater *water = run.dam->water.get())
        table.add("pressure_" + number_text(depth),
                  [water, point = water->point_at(depth)] { return point.value(water->pressure()); });
  }

  void HistoryObserver::declare_point(const std::string &name, const PlaceInDam &place)
  {
    history_columns.add_vector(name,
                               [this, place] {
                                 return place.interpolated([this](const unsigned int node)
                                                           { return run.relative_to_base(node); });
                               });
    points.push_back(name);
    places.push_back(place);
  }

  void HistoryObserver::declare_accelerations()
  {
    for (std::size_t k = 0; k < points.size(); ++k)
      history_columns.add_vector(points[k] + "_acceleration",
                                 [this, k]
                                 {
                                   return places[k].interpolated([this](const unsigned int node)
                                                                 { return run.absolute_acceleration(node); });
                                 });
  }

  void HistoryObserver::declare_energy()
  {
    TableColumns &table = energy_columns;
    const auto    now = [this]() -> const Energy    &{ return run.integrator->state().energy; };
    const auto    first = [this]() -> const Energy    &{ return run.integrator->initial_energy(); };
    const auto   &laws = run.dam->layout.laws;
    table.add("time", [this] { return run.integrator->state().time; });
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
    if (laws.have_seats())
      table.add("joint_stored", stored);
    if (laws.have_bonds())
      table.add("joint_fracture", fracture);
    if (laws.have_memory()) // name of earlier versions, for one release
      table.add("bond", [=] { return stored() + fracture(); });
    for (const Neighbour *neighbour : run.dam->neighbours)
      table.add_named([neighbour] { return neighbour->energies(); });
  }

  void HistoryObserver::record()
  {
    history_columns.record();
    energy_columns.record();
    const double balance = run.integrator->state().energy.balance(run.integrator->initial_energy());
    imbalance = std::max(imbalance, std::abs(balance));
  }

  void HistoryObserver::flush()
  {
    history_file.append(history);
    energy_file.append(energy);
  }

  void HistoryObserver::open(const std::string &directory)
  {
    history_file.open(directory + "/history.csv", history);
    energy_file.open(directory + "/energy.csv", energy);
  }

  void HistoryObserver::finish(const std::string &directory, Log &)
  {
    if (run.n_steps > 0)
      FloorAccelerations(history, points)
          .spectra(run.motion.dt, run.scene().motion.damping)
          .write(directory + "/floor_spectra.csv");
  }

  void HistoryObserver::report(Log &log) const
  {
    if (run.n_steps == 0)
      return;
    log.line("Residual  at the end: kinetic energy %.1e of the largest energy", kinetic_share());
    log.line("Crest     %s%s", FloorAccelerations(history, points).in_words().c_str(),
             crown_is_at_joint ? "; the crown is at a joint, where peaks in impacts depend on the time step"
                               : "");
  }

  void HistoryObserver::save(boost::archive::binary_oarchive &archive) const
  {
    archive << history << energy << imbalance;
  }

  void HistoryObserver::load(boost::archive::binary_iarchive &archive)
  {
    archive >> history >> energy >> imbalance;
  }
} // namespace Voussoir
