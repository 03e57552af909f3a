// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/entries.h>
#include <voussoir/base/error.h>
#include <voussoir/base/nearest_name.h>
#include <voussoir/base/number_text.h>
#include <voussoir/base/units.h>
#include <voussoir/dam/load_names.h>
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
      const std::string              what = "Entry \"Loads/Combinations\": combination \"" + name + "\"";
      const std::vector<std::string> load_names = items_of(static_load_names() + ", earthquake");
      std::map<std::string, double>  factors;
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

  void LoadParameters::add_parameters(Entries &prm)
  {
    const auto map = [] {
      return Patterns::Map(Patterns::Anything(), Patterns::Anything(), 0, Patterns::Map::max_int_value, ";");
    };
    prm.enter_subsection("Loads");
    prm.add_parameter(
        "Combination", combination,
        "Name of the active load combination, one of \"Combinations\". Empty: all loads, with the "
        "factor 1.",
        Patterns::Anything());
    prm.add_parameter(
        "Combinations", combinations,
        "Load combinations, as \"NAME: LOAD FACTOR, LOAD FACTOR; NAME: ...\". A missing factor is 1. Loads "
        "that are not listed are inactive. Loads: " +
            static_load_docs() + ", earthquake.",
        map());
    prm.add_parameter(
        "Concentrated", concentrated,
        "Forces at points, as \"NAME: x y z Fx Fy Fz; NAME: ...\" in m and N. A force at a point of an "
        "element acts on the nodes of the element.",
        map());
    prm.add_parameter(
        "Force history", force_history,
        "Forces at points with a history, as \"NAME: x y z; dx dy dz; FILE; NAME: ...\": point [m], direction "
        "and file with two columns, time [s] and force [N]. The force is linear between the rows and constant "
        "before and after them. The static state has its first value; of two rows with the same time the "
        "second holds from then on, so that \"0 1e6\" and \"0 0\" release a static pull.",
        Patterns::Anything());
    prm.add_parameter("Crest line", crest_line,
                      "Force per length along an edge of the crest, as \"qx qy qz\" in N/m. Empty: none.",
                      Patterns::Anything());
    prm.add_parameter("Crest edge", crest_edge, "Edge of the crest on which the line load acts.",
                      Patterns::Selection("upstream|downstream"));
    add_load_parameters(*this, prm);
    prm.leave_subsection();
  }

  void LoadParameters::check() const
  {
    point_loads();
    force_histories();
    line_load();
    if (silt.coefficient < 0. && silt.coefficient != -1.)
      throw InputError(
          "Entry \"Loads/Silt/Coefficient\" must be at least 0, or -1 for Rankine's coefficient, but it is " +
          number_text(silt.coefficient) + ".");
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

  std::vector<ForceHistory> LoadParameters::force_histories() const
  {
    std::vector<ForceHistory> forces;
    std::istringstream        in(force_history);
    std::vector<std::string>  parts;
    for (std::string part; std::getline(in, part, ';');)
      parts.push_back(part);
    for (std::size_t i = 0; i < parts.size(); i += 3)
    {
      const auto                colon = parts[i].find(':');
      const std::vector<double> x = numbers_in(parts[i].substr(colon == std::string::npos ? 0 : colon + 1)),
                                d = numbers_in(i + 1 < parts.size() ? parts[i + 1] : "");
      const std::vector<std::string> file = items_of(i + 2 < parts.size() ? parts[i + 2] : "");
      if (colon == std::string::npos || x.size() != 3 || d.size() != 3 || file.size() != 1)
        throw InputError(
            "Entry \"Loads/Force history\" has \"" + parts[i] +
            "\"; write \"NAME: x y z; dx dy dz; FILE\", separated by semicolons: a point in m, a "
            "direction and a file with time [s] and force [N].");
      const double length = std::hypot(d[0], d[1], d[2]);
      if (!(length > 0.))
        throw InputError("Entry \"Loads/Force history\": the direction of \"" + parts[i] + "\" is zero.");
      const std::vector<std::string> name = items_of(parts[i].substr(0, colon));
      forces.push_back({name.empty() ? "" : name[0],
                        {{x[0], x[1], x[2]}},
                        {{d[0] / length, d[1] / length, d[2] / length}},
                        file[0]});
    }
    return forces;
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
    using Kind = StaticStage::Kind;
    const std::map<std::string, Kind> kinds = {
        {"fill", Kind::fill}, {"grout", Kind::grout}, {"day", Kind::day}, {"cut", Kind::cut}};
    std::vector<StaticStage> stages;
    for (const std::string &item : items_of(text))
    {
      const std::string what = "Entry \"Statics/Stages\" has \"" + item + "\"";
      const auto        blank = item.find(' ');
      const auto        kind = kinds.find(item.substr(0, blank));
      std::string       of = blank == std::string::npos ? "" : item.substr(blank + 1);
      StaticStage       stage{kind == kinds.end() ? Kind::fill : kind->second, std::nan("")};
      if (const auto by = of.rfind(" by "); stage.kind == Kind::cut && by != std::string::npos)
      {
        stage.joint = of.substr(0, by);
        stage.value = number_in_unit(of.substr(by + 4), "m", what + ", whose width");
      }
      else if (stage.kind != Kind::cut)
      {
        if (const auto at = of.rfind(" at "); stage.kind == Kind::grout && at != std::string::npos)
        {
          stage.pressure = number_in_unit(of.substr(at + 4), "Pa", what + ", whose pressure");
          of.resize(at);
        }
        const std::vector<double> value = numbers_in(of);
        stage.value = value.size() == 1 ? value[0] : std::nan("");
      }
      if (kind == kinds.end() || !std::isfinite(stage.value) || !std::isfinite(stage.pressure) ||
          stage.pressure < 0. || (stage.kind == Kind::cut && stage.value <= 0.))
        throw InputError(
            what +
            "; a stage is \"fill Z\" (the reservoir to the level z, in m), \"grout Z\" or \"grout Z at P\" "
            "(the joints up to z, with the pressure P of the fluid grout), \"cut J by W\" (joint J by a "
            "saw of the width W) or \"day D\" (the temperatures of that day), as in \"grout 140 at "
            "0.5 MPa, fill 100, grout 210, cut 5 by 10 mm\".");
      stages.push_back(stage);
    }
    return stages;
  }
} // namespace Voussoir
