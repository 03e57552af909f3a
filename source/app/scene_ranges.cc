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
    /** What dams, rock, water and earthquakes have; in the declared units. Zero switches things off. */
    struct Range
    {
      const char *entry;
      double      low, high;
      bool        or_zero = false;
    };

    const std::vector<Range> ranges = {{"Mesh/Arch210/Rock/Upstream", 50., 2000.},
                                       {"Mesh/Arch210/Rock/Downstream", 50., 2000.},
                                       {"Mesh/Arch210/Rock/Sides", 50., 2000.},
                                       {"Mesh/Arch210/Rock/Depth", 50., 2000.},
                                       {"Mesh/Arch210/Rock/Element size", 2., 100.},
                                       {"Concrete/Young's modulus", 5e9, 6e10},
                                       {"Concrete/Poisson's ratio", .1, .3, true},
                                       {"Concrete/Density", 1800., 3000.},
                                       {"Damping/Ratio", .001, .2, true},
                                       {"Damping/Frequency 1", 0., 20.},
                                       {"Damping/Frequency 2", .5, 100.},
                                       {"Reservoir/Density", 900., 1300., true},
                                       {"Reservoir/Factor", .1, 1.5, true},
                                       {"Reservoir/Water level", -500., 9000.},
                                       {"Joints/Friction", .1, 2., true},
                                       {"Joints/Keys/Height", .005, 2., true},
                                       {"Joints/Keys/Clearance", 0., .1},
                                       {"Joints/Keys/Flank angle", 10., 80., true},
                                       {"Joints/Keys/Friction", -1., 2.},
                                       {"Joints/Strength", 1e5, 6e6, true},
                                       {"Joints/Fracture energy", 10., 1000., true},
                                       {"Statics/Gravity", 9.7, 9.9},
                                       {"Motion/Duration", 0., 300.},
                                       {"Motion/Time step", 1e-4, .05},
                                       {"Motion/Characteristic period", .1, 2.},
                                       {"Motion/Maximum beta", 1.5, 4.},
                                       {"Motion/Peak acceleration", .005, 2.},
                                       {"Motion/Vertical ratio", .2, 1.5},
                                       {"Motion/Damping", .005, .2},
                                       {"Loads/Temperature/Upstream face", -40., 50.},
                                       {"Loads/Temperature/Downstream face", -40., 60.},
                                       {"Loads/Temperature/Grouting", -10., 40.},
                                       {"Loads/Temperature/Expansion", 5e-6, 1.5e-5},
                                       {"Loads/Tail water/Density", 900., 1300., true},
                                       {"Loads/Silt/Density", 300., 1300., true},
                                       {"Loads/Silt/Friction angle", 10., 45.},
                                       {"Loads/Silt/Coefficient", .2, 1.},
                                       {"Limits/Tensile strength", 1e5, 2e7, true},
                                       {"Limits/Demand-capacity ratio", .2, 10., true},
                                       {"Limits/Overstress duration", .01, 10., true},
                                       {"Limits/Tension", 1e5, 5e7, true},
                                       {"Limits/Compression", 1e6, 2e8, true},
                                       {"Limits/Opening", 1e-4, .5, true},
                                       {"Limits/Slip", 1e-4, .5, true},
                                       {"Limits/Waterstop depth", .1, 10.},
                                       {"Limits/Waterstop opening", 1e-4, .5, true},
                                       {"Limits/Waterstop slip", 1e-4, .5, true},
                                       {"Limits/Base friction", .2, 2., true},
                                       {"Limits/Base cohesion", 1e4, 1e7, true},
                                       {"Limits/Sliding safety", .5, 10., true},
                                       {"Limits/Key shear stress", 1e4, 2e7, true},
                                       {"Foundation/Young's modulus", 5e8, 1.2e11},
                                       {"Foundation/Poisson's ratio", .1, .4, true},
                                       {"Foundation/Density", 1800., 3300.},
                                       {"Foundation/Mass damping", 0., 10.},
                                       {"Foundation/Stiffness damping", 0., .01}};

    const std::map<std::string, std::string> examples = {
        {"Pa", "21 GPa"}, {"kg/m^3", "2.4 t/m^3"}, {"m", "20 cm"},        {"s", "10 ms"},
        {"g", "3 m/s^2"}, {"m/s^2", "1 g"},        {"degrees", "0.5 rad"}};
  } // namespace

  std::string implausible(const UsedValue &used)
  {
    const auto range =
        std::find_if(ranges.begin(), ranges.end(), [&](const Range &r) { return used.range == r.entry; });
    const double value = used.value;
    if (range == ranges.end() || (value >= range->low && value <= range->high) ||
        (range->or_zero && value == 0.))
      return "";
    const std::string  unit = used.unit == "-" ? "" : " " + used.unit;
    std::ostringstream text;
    text << used.what << " is " << value << unit << ": usual is " << range->low << " to " << range->high
         << unit << ".";
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
          day_of.emplace(face_temperatures(temperature, scene.directory)[i], day);
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

  std::vector<std::string> entries_with_ranges()
  {
    std::vector<std::string> entries;
    for (const Range &range : ranges)
      entries.push_back(range.entry);
    return entries;
  }
} // namespace Voussoir
