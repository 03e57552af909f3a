// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/app/scene_ranges.h>
#include <voussoir/base/error.h>
#include <voussoir/dam/temperature.h>

#include <algorithm>
#include <cstdlib>
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
    if (found == usual.end())
      return "";
    const UsualRange &range = found->second;
    if ((value >= range.low && value <= range.high) || (range.or_zero && value == 0.))
      return "";
    const std::string  unit = used.unit == "-" ? "" : " " + used.unit;
    std::ostringstream text;
    text << used.what << " is " << value << unit << ": usual is " << range.low << " to " << range.high << unit
         << ".";
    if (const auto example = examples.find(used.unit); example != examples.end())
      text << " A value may carry its unit, as in \"" << example->second << "\".";
    else if (used.unit == "degC" && value > 200.)
      text << " Is it in kelvin? 0 degC are 273.15 K.";
    return text.str();
  }

  UsedValue used_value(const WrittenEntry &entry)
  {
    const std::string name = entry.declared.name();
    return {name + " (" + entry.place + ")", name, entry.declared.unit(),
            std::strtod(entry.value.c_str(), nullptr)};
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
        values.push_back({of + "Young's modulus", section + "/Young's modulus", "Pa", material.young});
        values.push_back({of + "Poisson's ratio", section + "/Poisson's ratio", "-", material.poisson});
        if (has_mass)
          values.push_back({of + "the density", section + "/Density", "kg/m^3", material.density});
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
          values.push_back({what.str(), std::string("Loads/Temperature/") + faces[i], "degC", value});
        }
      }
    }
  } // namespace

  std::vector<UsedValue> values_of_sources(const Scene &scene)
  {
    std::vector<UsedValue>      values;
    const FoundationParameters &foundation = scene.foundation;
    add_materials(zone_materials(scene.concrete_zones, "Concrete/Zones"), "Concrete", true, values);
    if (foundation.model != "rigid")
      add_materials(foundation.zone_materials(), "Foundation", foundation.model == "rock", values);
    try
    {
      if (!scene.loads.temperature.table.empty() && scene.loads.factor("temperature") != 0.)
        add_table(scene, values);
    }
    catch (const InputError &) // reported where the load is computed
    {
    }
    return values;
  }
} // namespace Voussoir
