// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/base/names.h>
#include <voussoir/base/units.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace Voussoir
{
  namespace
  {
    struct Unit
    {
      const char *name, *dimension;
      double      factor; ///< SI units; degrees for angles
    };

    constexpr double standard_gravity = 9.80665, foot = .3048, pound_force = 4.4482216152605,
                     pound = .45359237;

    const std::vector<Unit> units = {
        // Messages list the units of a dimension in this order.
        {"m", "length", 1.},
        {"km", "length", 1e3},
        {"dm", "length", .1},
        {"cm", "length", 1e-2},
        {"mm", "length", 1e-3},
        {"ft", "length", foot},
        {"in", "length", foot / 12.},
        {"s", "time", 1.},
        {"ms", "time", 1e-3},
        {"min", "time", 60.},
        {"Pa", "pressure", 1.},
        {"N/m^2", "pressure", 1.},
        {"kPa", "pressure", 1e3},
        {"kN/m^2", "pressure", 1e3},
        {"MPa", "pressure", 1e6},
        {"N/mm^2", "pressure", 1e6},
        {"MN/m^2", "pressure", 1e6},
        {"GPa", "pressure", 1e9},
        {"kN/mm^2", "pressure", 1e9},
        {"bar", "pressure", 1e5},
        {"psi", "pressure", pound_force / (foot * foot / 144.)},
        {"ksi", "pressure", 1e3 * pound_force / (foot * foot / 144.)},
        {"kg/m^3", "density", 1.},
        {"t/m^3", "density", 1e3},
        {"g/cm^3", "density", 1e3},
        {"kg/dm^3", "density", 1e3},
        {"kN/m^3", "density", 1e3 / standard_gravity}, // unit weight
        {"lb/ft^3", "density", pound / (foot * foot * foot)},
        {"m/s^2", "acceleration", 1.},
        {"cm/s^2", "acceleration", 1e-2},
        {"mm/s^2", "acceleration", 1e-3},
        {"gal", "acceleration", 1e-2},
        {"Gal", "acceleration", 1e-2},
        {"g", "acceleration", standard_gravity},
        {"%g", "acceleration", .01 * standard_gravity},
        {"ft/s^2", "acceleration", foot},
        {"m/s", "velocity", 1.},
        {"km/s", "velocity", 1e3},
        {"cm/s", "velocity", 1e-2},
        {"mm/s", "velocity", 1e-3},
        {"ft/s", "velocity", foot},
        {"degrees", "angle", 1.},
        {"degree", "angle", 1.},
        {"deg", "angle", 1.},
        {"\u00b0", "angle", 1.},
        {"rad", "angle", 180. / M_PI},
        {"N/m", "force per length", 1.},
        {"Pa/m", "pressure per length", 1.},
        {"MPa/m", "pressure per length", 1e6},
        {"MPa/mm", "pressure per length", 1e9},
        {"GPa/m", "pressure per length", 1e9},
        {"J/m^2", "force per length", 1.},
        {"N/mm", "force per length", 1e3},
        {"kN/m", "force per length", 1e3},
        {"Hz", "frequency", 1.},
        {"kHz", "frequency", 1e3},
        {"1/s", "rate", 1.},
        {"degC", "temperature", 1.},
        {"\u00b0C", "temperature", 1.},
        {"1/K", "thermal expansion", 1.},
        {"1/degC", "thermal expansion", 1.},
        {"1e-6/K", "thermal expansion", 1e-6},
        {"%", "ratio", 1e-2},
        {"-", "ratio", 1.},
    };

    /** "kg / m³" -> "kg/m^3", "kg/m3" -> "kg/m^3", "cm/sec/sec" -> "cm/s^2" */
    std::string spelled(std::string text)
    {
      text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
      for (const auto &other : {std::pair<const char *, const char *>{"\u00b2", "2"},
                                {"\u00b3", "3"},
                                {"sec", "s"},
                                {"s/s", "s2"},
                                {"gals", "gal"}})
        for (std::size_t at; (at = text.find(other.first)) != std::string::npos;)
          text.replace(at, std::string(other.first).size(), other.second);
      const auto n = text.size();
      if (n > 1 && (text[n - 1] == '2' || text[n - 1] == '3') &&
          std::isalpha(static_cast<unsigned char>(text[n - 2])))
        text.insert(n - 1, "^");
      return text;
    }

    const Unit *find_unit(const std::string &name)
    {
      const std::string text = spelled(name);
      const auto        found =
          std::find_if(units.begin(), units.end(), [&](const Unit &unit) { return text == unit.name; });
      return found == units.end() ? nullptr : &*found;
    }

    std::string units_of(const std::string &dimension)
    {
      return listed(units, [&](const Unit &unit) { return dimension == unit.dimension ? unit.name : ""; });
    }
  } // namespace

  std::string unit_name(const std::string &text, const std::string &dimension)
  {
    const Unit *const unit = find_unit(text);
    if (unit == nullptr || dimension != unit->dimension)
      return "";
    const auto first = std::find_if(units.begin(), units.end(),
                                    [&](const Unit &other)
                                    { return dimension == other.dimension && other.factor == unit->factor; });
    return first->name;
  }

  std::string unit_choices(const std::string &dimension)
  {
    std::string choices;
    for (const Unit &unit : units)
      if (dimension == unit.dimension)
      {
        std::string name = unit.name;
        choices += (choices.empty() ? "" : "|") + name;
        if (const auto power = name.find('^'); power != std::string::npos)
          choices += "|" + name.erase(power, 1);
      }
    return choices;
  }

  std::string in_declared_unit(const std::string &value, const std::string &declared, const std::string &what)
  {
    char        *end = nullptr;
    const double number = std::strtod(value.c_str(), &end);
    std::string  rest = end;
    rest.erase(0, rest.find_first_not_of(" \t"));
    rest.erase(rest.find_last_not_of(" \t") + 1);
    if (end == value.c_str() || rest.empty() || !std::isfinite(number) || rest[0] == ',' ||
        value.find_first_of("xX") != std::string::npos) // excludes hexadecimal numbers
      return value;

    const bool  is_pure = declared.empty() || declared == "-";
    const Unit *written = find_unit(rest), *target = find_unit(is_pure ? "-" : declared);
    if (written == nullptr || target == nullptr || written->dimension != std::string(target->dimension))
    {
      if (is_pure)
        throw InputError(what + " has no unit, but the value is \"" + value + "\". Give the number alone.");
      throw InputError(
          what + " is in " + declared + "; \"" + rest + "\" is " +
          (written == nullptr ? std::string("not a unit") : "a unit of " + std::string(written->dimension)) +
          ". " + (target == nullptr ? "Give" : "Use " + units_of(target->dimension) + ", or give") +
          " the number alone, in " + declared + ".");
    }
    char text[40];
    std::snprintf(text, sizeof(text), "%.15g", number * written->factor / target->factor);
    return text;
  }

  double number_in_unit(const std::string &value, const std::string &declared, const std::string &what)
  {
    const std::string text = in_declared_unit(value, declared, what);
    char             *end = nullptr;
    const double      x = std::strtod(text.c_str(), &end);
    return end == text.c_str() || *end != '\0' ? std::nan("") : x;
  }
} // namespace Voussoir
