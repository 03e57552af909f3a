// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/output/archive.h>
#include <voussoir/output/observers.h>
#include <voussoir/output/recorders.h>

#include <algorithm>
#include <cstdio>

namespace Voussoir
{
  namespace
  {
    constexpr double atmospheric = 101325.; // [Pa]
  }                                         // namespace

  void WaterObserver::record()
  {
    const std::vector<double> pressure = water.pressure();
    const double              time = run.integrator->state().time;
    largest.resize(pressure.size(), 0.);
    smallest.resize(pressure.size(), 0.);
    for (unsigned int i = 0; i < pressure.size(); ++i)
    {
      largest[i] = std::max(largest[i], pressure[i]);
      smallest[i] = std::min(smallest[i], pressure[i]);
      if (pressure[i] > highest.value)
        highest = {pressure[i], time, i};
      if (pressure[i] < lowest.value)
        lowest = {pressure[i], time, i};
      if (const double whole = atmospheric + water.static_pressure(i) + pressure[i]; whole < driest.value)
        driest = {whole, time, i};
    }
  }

  void WaterObserver::write_tables(const std::string &directory)
  {
    Table table;
    table.columns = {"x", "y", "z", "static_pressure", "largest_pressure", "smallest_pressure"};
    for (unsigned int i = 0; i < largest.size(); ++i)
    {
      const auto p = water.mesh().points[i];
      table.rows.push_back({p[0], p[1], p[2], water.static_pressure(i), largest[i], smallest[i]});
    }
    table.write(directory + "/water_pressure.csv");
  }

  void WaterObserver::report(Log &log) const
  {
    const auto p = water.mesh().points[highest.node];
    log.line("Water     largest dynamic pressure %.3f MPa at (%.1f, %.1f, %.1f) m, smallest %.3f MPa",
             1e-6 * highest.value, p[0], p[1], p[2], 1e-6 * lowest.value);
    const auto q = water.mesh().points[driest.node];
    if (driest.value >= 0.)
      return;
    char place[100], pressure[40];
    std::snprintf(place, sizeof(place), "(%.1f, %.1f, %.1f) m, t = %.3f s", q[0], q[1], q[2], driest.time);
    std::snprintf(pressure, sizeof(pressure), "%.3f MPa", 1e-6 * driest.value);
    log.warn(
        {Warning::Kind::physics,
         std::string("the absolute pressure of the water falls to ") + pressure + " at " + place +
             ": the water would cavitate there. The model has no cavitation; the later pressures there are "
             "upper bounds of the suction.",
         place});
  }

  std::vector<FieldWriter::NodalField> WaterObserver::fields() const
  {
    const std::vector<double> high = water.at_dam(largest), low = water.at_dam(smallest);
    return {{"max_water_pressure", {high.begin(), high.end()}},
            {"min_water_pressure", {low.begin(), low.end()}}};
  }

  Json WaterObserver::json() const
  {
    const auto of = [&](const Extreme &extreme)
    {
      return Json()
          .add("value", extreme.value)
          .add_list("place", water.mesh().points[extreme.node])
          .add("time", extreme.time);
    };
    return Json()
        .add("max_dynamic_pressure", of(highest))
        .add("min_dynamic_pressure", of(lowest))
        .add("min_absolute_pressure", of(driest));
  }

  void WaterObserver::save(boost::archive::binary_oarchive &archive) const
  {
    archive << largest << smallest;
    for (const Extreme *extreme : {&highest, &lowest, &driest})
      archive << extreme->value << extreme->time << extreme->node;
  }

  void WaterObserver::load(boost::archive::binary_iarchive &archive)
  {
    archive >> largest >> smallest;
    for (Extreme *extreme : {&highest, &lowest, &driest})
      archive >> extreme->value >> extreme->time >> extreme->node;
  }
} // namespace Voussoir
