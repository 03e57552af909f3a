// SPDX-License-Identifier: GPL-3.0-or-later
#include <deal.II/base/parameter_handler.h>

#include <voussoir/base/error.h>
#include <voussoir/base/nearest_name.h>
#include <voussoir/dam/load_parameters.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace Voussoir
{
  using namespace dealii;

  namespace
  {
    const std::vector<std::string> load_names = {"weight",       "water",       "tail water",
                                                 "silt",         "temperature", "uplift",
                                                 "concentrated", "crest line",  "earthquake"};

    void add_temperature(TemperatureParameters &p, ParameterHandler &prm)
    {
      prm.enter_subsection("Temperature");
      prm.add_parameter("Upstream face", p.upstream,
                        "Temperature of the upstream face; through the thickness it is linear [degC].");
      prm.add_parameter("Downstream face", p.downstream, "Temperature of the downstream face [degC].");
      prm.add_parameter("Grouting", p.grouting,
                        "Temperature at which the joints were closed and the dam is free of stress [degC].");
      prm.add_parameter("Expansion", p.expansion, "Coefficient of thermal expansion of the concrete [1/K].",
                        Patterns::Double(0., 1e-3));
      prm.add_parameter("Table", p.table,
                        "File with the temperatures of the faces in time, in place of the two entries: "
                        "lines of day, upstream and downstream [degC], linear between; relative to the "
                        "directory of this file.",
                        Patterns::Anything());
      prm.add_parameter("Day", p.day, "The day of the table, in its counting.");
      prm.leave_subsection();
    }

    void add_water_and_silt(LoadParameters &p, ParameterHandler &prm)
    {
      prm.enter_subsection("Tail water");
      prm.add_parameter("Level", p.tail_water.level, "z of the water surface downstream; -10000: none [m].");
      prm.add_parameter("Density", p.tail_water.density, "Density of the tail water [kg/m^3].",
                        Patterns::Double(0.));
      prm.leave_subsection();
      prm.enter_subsection("Silt");
      prm.add_parameter("Level", p.silt.level,
                        "z of the surface of the sediment upstream; -10000: none [m].");
      prm.add_parameter(
          "Density", p.silt.density,
          "Density of the sediment under water, less that of the water; a unit weight in kN/m^3 "
          "is taken, too [kg/m^3].",
          Patterns::Double(0.));
      prm.add_parameter(
          "Friction angle", p.silt.friction_angle,
          "Angle of friction of the sediment [degrees]: lateral pressure (1 - sin)/(1 + sin) of "
          "the vertical one, Rankine's active pressure.",
          Patterns::Double(0., 89.));
      prm.add_parameter("Coefficient", p.silt.coefficient,
                        "Lateral over vertical pressure of the sediment [-]; -1: from the friction angle.",
                        Patterns::Double(-1., 10.));
      prm.leave_subsection();
    }

    void add_uplift(UpliftParameters &p, ParameterHandler &prm)
    {
      prm.enter_subsection("Uplift");
      prm.add_parameter("Joints", p.joints,
                        "Water enters joints from the upstream face where they open in the static state, and "
                        "presses them apart with the full pressure of the reservoir.");
      prm.add_parameter(
          "Base", p.base,
          "Write the uplift at the base: the pressure of the reservoir at the heel, of the tail "
          "water at the toe, linear between. A base that cannot open is not moved by it: its "
          "compression is carried by the water in part (doc/loads.md).");
      prm.add_parameter("Drain position", p.drain_position,
                        "Place of the drains, from upstream, over the thickness of the base [-].",
                        Patterns::Double(0., 1.));
      prm.add_parameter("Drain efficiency", p.drain_efficiency,
                        "Share by which the drains lower the head over the tail water there [-].",
                        Patterns::Double(0., 1.));
      prm.leave_subsection();
    }

    /** The numbers in a text; empty if there is anything else. */
    std::vector<double> numbers_in(const std::string &text)
    {
      std::vector<double> numbers;
      std::istringstream  in(text);
      for (std::string word; in >> word;)
      {
        char        *end = nullptr;
        const double x = std::strtod(word.c_str(), &end);
        if (end == word.c_str() || *end != '\0' || !std::isfinite(x))
          return {};
        numbers.push_back(x);
      }
      return numbers;
    }

    /** The parts between commas, each without blanks around it and single ones in it. */
    std::vector<std::string> items_of(const std::string &text)
    {
      std::vector<std::string> items;
      std::istringstream       in(text);
      for (std::string part; std::getline(in, part, ',');)
      {
        std::istringstream words(part);
        std::string        item;
        for (std::string word; words >> word;)
          item += (item.empty() ? "" : " ") + word;
        if (!item.empty())
          items.push_back(item);
      }
      return items;
    }

    /** "weight, water 1.1": factors by load. Throws InputError for loads that are not known, or named twice.
     */
    std::map<std::string, double> factors_in(const std::string &name, const std::string &text)
    {
      const std::string             what = "Entry \"Loads/Combinations\": combination \"" + name + "\"";
      std::map<std::string, double> factors;
      for (const std::string &item : items_of(text))
      {
        const auto blank = item.rfind(' ');
        const auto value =
            blank == std::string::npos ? std::vector<double>() : numbers_in(item.substr(blank));
        std::string load = value.empty() ? item : item.substr(0, blank);
        if (std::find(load_names.begin(), load_names.end(), load) == load_names.end())
          throw InputError(what + " has \"" + item + "\", which is no load. Did you mean \"" +
                           nearest_name(load_names, load) + "\"? Write it as in \"" + name +
                           ": weight, water 1.1, temperature\".");
        if (!factors.emplace(load, value.empty() ? 1. : value[0]).second)
          throw InputError(what + " names the load \"" + load + "\" twice. Leave one.");
      }
      return factors;
    }
  } // namespace

  double SiltParameters::pressure_coefficient() const
  {
    const double sine = std::sin(friction_angle * std::acos(-1.) / 180.);
    return coefficient >= 0. ? coefficient : (1. - sine) / (1. + sine);
  }

  void LoadParameters::add_parameters(ParameterHandler &prm)
  {
    const auto map = [] {
      return Patterns::Map(Patterns::Anything(), Patterns::Anything(), 0, Patterns::Map::max_int_value, ";");
    };
    prm.enter_subsection("Loads");
    prm.add_parameter("Combination", combination,
                      "Name of the combination of loads that acts, one of Combinations; empty: all loads of "
                      "the scene, once each.",
                      Patterns::Anything());
    prm.add_parameter(
        "Combinations", combinations,
        "Combinations, as \"NAME: LOAD FACTOR, LOAD FACTOR; NAME: ...\"; without a factor it is "
        "1, and what is not named does not act. Loads: weight, water (with its added mass), tail "
        "water, silt, temperature, uplift, concentrated, crest line, earthquake.",
        map());
    prm.add_parameter(
        "Concentrated", concentrated,
        "Forces on single nodes, as \"NAME: x y z Fx Fy Fz; NAME: ...\" in m and N: on the node "
        "nearest to the place.",
        map());
    prm.add_parameter("Crest line", crest_line,
                      "Force per length along an edge of the crest, as \"qx qy qz\" in N/m; empty: none.",
                      Patterns::Anything());
    prm.add_parameter("Crest edge", crest_edge, "The edge of the crest on which the line load acts.",
                      Patterns::Selection("upstream|downstream"));
    add_temperature(temperature, prm);
    add_water_and_silt(*this, prm);
    add_uplift(uplift, prm);
    prm.leave_subsection();
  }

  void LoadParameters::check() const
  {
    point_loads();
    line_load();
    if (silt.coefficient < 0. && silt.coefficient != -1.)
      throw InputError(
          "Entry \"Loads/Silt/Coefficient\" must be at least 0, or -1 for Rankine's coefficient.");
    std::vector<std::string> names;
    for (const auto &entry : combinations)
    {
      factors_in(entry.first, entry.second);
      names.push_back(entry.first);
    }
    if (!combination.empty() && combinations.count(combination) == 0)
      throw InputError("Entry \"Loads/Combination\" is \"" + combination +
                       "\", which is none of \"Loads/Combinations\"" +
                       (names.empty() ? std::string(".")
                                      : ". Did you mean \"" + nearest_name(names, combination) + "\"?") +
                       " Define it there, as in \"" + combination + ": weight, water 1.1, temperature\".");
  }

  double LoadParameters::factor(const std::string &load) const
  {
    if (combination.empty())
      return 1.;
    const auto factors = factors_in(combination, combinations.at(combination));
    const auto found = factors.find(load);
    return found == factors.end() ? 0. : found->second;
  }

  std::map<std::string, PointLoad> LoadParameters::point_loads() const
  {
    std::map<std::string, PointLoad> loads;
    for (const auto &entry : concentrated)
    {
      const std::vector<double> x = numbers_in(entry.second);
      if (x.size() != 6)
        throw InputError("Entry \"Loads/Concentrated\": load \"" + entry.first + "\" is \"" + entry.second +
                         "\"; write six numbers, x y z Fx Fy Fz, in m and N.");
      loads[entry.first] = {{{x[0], x[1], x[2]}}, {{x[3], x[4], x[5]}}};
    }
    return loads;
  }

  Vector3 LoadParameters::line_load() const
  {
    if (crest_line.empty())
      return {};
    const std::vector<double> q = numbers_in(crest_line);
    if (q.size() != 3)
      throw InputError("Entry \"Loads/Crest line\" is \"" + crest_line +
                       "\"; write three numbers, qx qy qz, in N/m.");
    return {{q[0], q[1], q[2]}};
  }

  std::vector<StaticStage> static_stages(const std::string &text)
  {
    std::vector<StaticStage> stages;
    for (const std::string &item : items_of(text))
    {
      const auto                blank = item.find(' ');
      const std::string         word = item.substr(0, blank);
      const std::vector<double> value =
          blank == std::string::npos ? std::vector<double>() : numbers_in(item.substr(blank));
      if (value.size() != 1 || (word != "fill" && word != "grout" && word != "day"))
        throw InputError(
            "Entry \"Statics/Stages\" has \"" + item +
            "\"; a stage is \"fill Z\" (the reservoir to the level z, in m), \"grout Z\" (the "
            "joints up to z) or \"day D\" (the temperatures of that day), as in \"grout 140, fill "
            "100, grout 210\".");
      const auto kind = word == "fill"    ? StaticStage::Kind::fill
                        : word == "grout" ? StaticStage::Kind::grout
                                          : StaticStage::Kind::day;
      stages.push_back({kind, value[0]});
    }
    return stages;
  }
} // namespace Voussoir
