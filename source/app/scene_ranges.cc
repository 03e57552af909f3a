// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/scene_ranges.h>
#include <voussoir/base/curve_file.h>
#include <voussoir/base/error.h>
#include <voussoir/base/number_text.h>
#include <voussoir/base/tensor3.h>
#include <voussoir/base/units.h>
#include <voussoir/dam/rock_wedge.h>
#include <voussoir/dam/temperature.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>

namespace Voussoir
{
  namespace
  {
    const std::map<std::string, std::string> examples = {
        {"Pa", "21 GPa"}, {"kg/m^3", "2.4 t/m^3"}, {"m", "20 cm"},        {"s", "10 ms"},
        {"g", "3 m/s^2"}, {"m/s^2", "1 g"},        {"degrees", "0.5 rad"}};
  } // namespace

  std::string implausible(const UsedValue &used, const UsualRanges &usual)
  {
    const auto   found = usual.find(used.range);
    const double value = used.value;
    if (found == usual.end() && used.of_list == nullptr)
      return "";
    const UsualRange &range = used.of_list != nullptr ? *used.of_list : found->second;
    if ((value >= range.low && value <= range.high) || (range.or_zero && value == 0.))
      return "";
    const std::string  unit = used.unit == "-" ? "" : " " + used.unit;
    std::ostringstream text;
    text << used.what << " is " << value << unit << ": usual is " << range.low << " to " << range.high << unit
         << ".";
    if (const auto example = examples.find(used.unit); !used.in_file && example != examples.end())
      text << " A value may carry its unit, as in \"" << example->second << "\".";
    else if (used.unit == "degC" && value > 200.)
      text << " Is it in kelvin? 0 degC are 273.15 K.";
    return text.str();
  }

  UsedValue used_value(const WrittenEntry &entry)
  {
    const std::string name = entry.declared.name();
    return {name + " (" + entry.place + ")", name, entry.declared.unit(),
            std::strtod(entry.value.c_str(), nullptr), entry.place};
  }

  namespace
  {
    /** Adds the materials of zones. @p section: whose entries have the usual ranges. */
    void add_materials(const std::map<std::string, Material> &zones, const std::string &section,
                       const bool has_mass, std::vector<UsedValue> &values)
    {
      for (const auto &[zone, material] : zones)
      {
        const std::string of = section + "/Zones: zone " + zone + ", ";
        values.push_back(
            {of + "Young's modulus", section + "/Young's modulus", "Pa", material.young, section + "/Zones"});
        values.push_back({of + "Poisson's ratio", section + "/Poisson's ratio", "-", material.poisson,
                          section + "/Zones"});
        if (has_mass)
          values.push_back(
              {of + "the density", section + "/Density", "kg/m^3", material.density, section + "/Zones"});
      }
    }

    /** Adds the lowest and the highest temperature of each face on the days that the scene uses. */
    void add_table(const Scene &scene, std::vector<UsedValue> &values)
    {
      TemperatureParameters temperature = scene.loads.temperature;
      std::vector<double>   days = {temperature.day};
      for (const StaticStage &stage : static_stages(scene.statics.stages))
        if (stage.kind == StaticStage::Kind::day)
          days.push_back(stage.value);
      constexpr const char *faces[2] = {"Upstream face", "Downstream face"};
      for (unsigned int i = 0; i < 2; ++i)
      {
        std::map<double, double> day_of; // by temperature
        for (const double day : days)
        {
          temperature.day = day;
          for (const auto &both : face_temperatures(temperature, scene.directory).faces)
            day_of.emplace(both[i], day);
        }
        if (day_of.size() > 2)
          day_of.erase(std::next(day_of.begin()), std::prev(day_of.end()));
        for (const auto &[value, day] : day_of)
        {
          std::ostringstream what;
          what << "Loads/Temperature/Table (" << temperature.table << "): " << faces[i] << " on day " << day;
          values.push_back(
              {what.str(), std::string("Loads/Temperature/") + faces[i], "degC", value, temperature.table});
        }
      }
    }
  } // namespace

  namespace
  {
    using NamedValues = std::vector<std::pair<std::string, double>>; // text after the entry, value

    /** Returns the lengths of a list of joints. */
    NamedValues lengths(const std::map<std::string, std::string> &of_joints, const char *entry)
    {
      NamedValues values;
      for (const auto &[joint, length] : of_joints)
        values.emplace_back(joint, number_in_unit(length, "m", entry));
      return values;
    }

    NamedValues initial_velocities(const Scene &scene)
    {
      double largest = 0.;
      for (const auto &block : scene.initial_velocities())
        largest = std::max(largest, norm(block.second));
      return {{"the largest velocity", largest}};
    }

    NamedValues widths_of_cuts(const Scene &scene)
    {
      NamedValues values;
      for (const StaticStage &stage : static_stages(scene.statics.stages))
        if (stage.kind == StaticStage::Kind::cut)
          values.emplace_back("width of the cut of " + stage.joint, stage.value);
      return values;
    }

    NamedValues pressures_of_grout(const Scene &scene)
    {
      NamedValues values;
      for (const StaticStage &stage : static_stages(scene.statics.stages))
        if (stage.kind == StaticStage::Kind::grout)
          values.emplace_back("pressure of grout " + number_text(stage.value), stage.pressure);
      return values;
    }

    NamedValues crest_line(const Scene &scene)
    {
      return {{"the force per length", norm(scene.loads.line_load())}};
    }

    NamedValues concentrated_forces(const Scene &scene)
    {
      NamedValues values;
      for (const auto &[name, load] : scene.loads.point_loads())
        values.emplace_back(name, norm(load.force));
      return values;
    }

    NamedValues largest_added_mass(const Scene &scene)
    {
      if (scene.reservoir.model != "added mass table")
        return {};
      const std::string file =
          (std::filesystem::path(scene.reservoir.directory) / scene.reservoir.table).string();
      const Curve curve = read_curve(file, {"Reservoir/Table, ", "depth", "depths", "[m]", "added mass", ""});
      return {{"largest added mass of " + scene.reservoir.table,
               *std::max_element(curve.y.begin(), curve.y.end())}};
    }

    /** Usual ranges of numbers in lists and tables. */
    struct ListedNumbers
    {
      const char *entry, *unit;
      UsualRange  range;
      NamedValues (*values)(const Scene &); ///< may throw InputError
      bool in_file = false;                 ///< see UsedValue
    };
    const std::vector<ListedNumbers> listed_numbers = {
        {"Joints/Initial gaps",
         "m",
         {1e-5, .05, true},
         [](const Scene &scene) { return lengths(scene.joints.gaps, "Joints/Initial gaps"); }},
        {"Joints/Keys/Clearances",
         "m",
         {0., .1},
         [](const Scene &scene) { return lengths(scene.joints.clearances, "Joints/Keys/Clearances"); }},
        {"Dynamics/Initial velocity", "m/s", {1e-4, 10., true}, initial_velocities},
        {"Statics/Stages", "m", {1e-5, .2}, widths_of_cuts},
        {"Statics/Stages", "Pa", {1e4, 5e6, true}, pressures_of_grout},
        {"Loads/Crest line", "N/m", {1e3, 5e6, true}, crest_line},
        {"Loads/Concentrated", "N", {1e3, 1e9, true}, concentrated_forces},
        {"Reservoir/Table", "kg/m^2", {1e3, 1e6}, largest_added_mass, true}};

    /** Usual range of a number of each part of the rock wedges. */
    template <class T> struct WedgeColumn
    {
      const char *name, *unit;
      UsualRange  range;
      double T::*number;
    };
    const std::vector<WedgeColumn<RockWedge>> wedge_columns = {
        {"density", "kg/m^3", {2000., 3500.}, &RockWedge::density},
        {"volume", "m^3", {10., 1e8}, &RockWedge::volume}};
    const std::vector<WedgeColumn<WedgePlane>> plane_columns = {
        {"area", "m^2", {1., 1e6}, &WedgePlane::area},
        {"friction", "-", {.2, 3.}, &WedgePlane::friction},
        {"cohesion", "Pa", {1e3, 1e7, true}, &WedgePlane::cohesion},
        {"uplift", "Pa", {1e3, 1e7, true}, &WedgePlane::uplift}};

    template <class T>
    void add_columns(const std::vector<WedgeColumn<T>> &columns, const T &part, const std::string &name,
                     std::vector<UsedValue> &values)
    {
      const std::string entry = "Limits/Wedges";
      for (const WedgeColumn<T> &column : columns)
        values.push_back({entry + ": " + column.name + " of " + name, entry, column.unit, part.*column.number,
                          entry, &column.range, true});
    }
  } // namespace

  std::vector<UsedValue> values_of_sources(const Scene &scene)
  {
    std::vector<UsedValue>      values;
    const FoundationParameters &foundation = scene.foundation;
    add_materials(zone_materials(scene.concrete_zones, "Concrete/Zones"), "Concrete", true, values);
    if (foundation.model != "rigid")
      add_materials(foundation.zone_materials(), "Foundation", foundation.model == "rock", values);
    for (const ListedNumbers &row : listed_numbers)
      try
      {
        for (const auto &[name, value] : row.values(scene))
          values.push_back({std::string(row.entry) + ": " + name, row.entry, row.unit, value, row.entry,
                            &row.range, row.in_file});
      }
      catch (const InputError &) // reported where the numbers are used
      {
      }
    try
    {
      if (!scene.loads.temperature.table.empty() && scene.loads.factor("temperature") != 0.)
        add_table(scene, values);
      for (const RockWedge &wedge : rock_wedges(scene))
      {
        add_columns(wedge_columns, wedge, "wedge " + wedge.name, values);
        for (const WedgePlane &plane : wedge.planes)
          add_columns(plane_columns, plane, "plane " + plane.name + " of wedge " + wedge.name, values);
      }
    }
    catch (const InputError &) // reported where the numbers are used
    {
    }
    return values;
  }
} // namespace Voussoir
