// SPDX-License-Identifier: GPL-3.0-or-later
// What users write into scenes: units, patterns in words, entries without effect, implausible values.

#include "testing.h"

#include <deal.II/base/parameter_handler.h>

#include <voussoir/app/scene_warnings.h>
#include <voussoir/base/nearest_name.h>
#include <voussoir/base/units.h>

#include <fstream>

using namespace Voussoir;
using namespace Testing;

namespace
{
  void test_units()
  {
    const auto converted = [](const std::string &value, const std::string &unit)
    { return in_declared_unit(value, unit, "Entry \"A/B\""); };
    const std::vector<std::array<std::string, 3>> cases = {{"21 GPa", "Pa", "21000000000"},
                                                           {"21GPa", "Pa", "21000000000"},
                                                           {"210 kN/mm2", "Pa", "210000000000"},
                                                           {"2.1e4 N/mm^2", "Pa", "21000000000"},
                                                           {"300 bar", "Pa", "30000000"},
                                                           {"1000 psi", "Pa", "6894757.29316836"},
                                                           {"0.5575 g", "g", "0.5575"},
                                                           {"9.80665 m/s2", "g", "1"},
                                                           {"1 g", "m/s^2", "9.80665"},
                                                           {"981 cm/s^2", "m/s^2", "9.81"},
                                                           {"981 gal", "m/s^2", "9.81"},
                                                           {"15 mm", "m", "0.015"},
                                                           {"10 ft", "m", "3.048"},
                                                           {"12 in", "m", "0.3048"},
                                                           {"-2.5 cm", "m", "-0.025"},
                                                           {"2400 kg/m3", "kg/m^3", "2400"},
                                                           {"2400 kg / m^3", "kg/m^3", "2400"},
                                                           {"2.4 t/m\u00b3", "kg/m^3", "2400"},
                                                           {"9.80665 kN/m3", "kg/m^3", "1000"},
                                                           {"10 ms", "s", "0.01"},
                                                           {"1 min", "s", "60"},
                                                           {"30 deg", "degrees", "30"},
                                                           {"30\u00b0", "degrees", "30"},
                                                           {"0.5235987755982988 rad", "degrees", "30"},
                                                           {"1.2 Hz", "Hz", "1.2"},
                                                           {"0.5 1/s", "1/s", "0.5"},
                                                           {"5 %", "-", "0.05"},
                                                           {"5", "Pa", "5"},
                                                           {"1e-5", "s", "1e-5"},
                                                           {"-1", "", "-1"},
                                                           {"nan", "Pa", "nan"},
                                                           {"much", "-", "much"},
                                                           {"2,4", "m", "2,4"}};
    for (const auto &c : cases)
      expect(converted(c[0], c[1]) == c[2], c[0] + " in " + c[1] + " is " + converted(c[0], c[1]));
    // Every unit, in the SI unit of its dimension: NIST SP 811 (2008), appendix B.
    const std::vector<std::pair<std::string, std::vector<std::pair<std::string, double>>>> all = {
        {"m", {{"m", 1.}, {"km", 1e3}, {"dm", .1}, {"cm", .01}, {"mm", 1e-3}, {"ft", .3048}, {"in", .0254}}},
        {"s", {{"s", 1.}, {"ms", 1e-3}, {"min", 60.}}},
        {"Pa",
         {{"Pa", 1.},
          {"N/m2", 1.},
          {"kPa", 1e3},
          {"kN/m2", 1e3},
          {"MPa", 1e6},
          {"N/mm2", 1e6},
          {"MN/m2", 1e6},
          {"GPa", 1e9},
          {"kN/mm2", 1e9},
          {"bar", 1e5},
          {"psi", 6894.757293168361},
          {"ksi", 6894757.293168361}}},
        {"kg/m^3",
         {{"kg/m3", 1.},
          {"t/m3", 1e3},
          {"g/cm3", 1e3},
          {"kg/dm3", 1e3},
          {"kN/m3", 101.9716212977928},
          {"lb/ft3", 16.01846337396014}}},
        {"m/s^2",
         {{"m/s2", 1.}, {"cm/s2", .01}, {"mm/s2", 1e-3}, {"gal", .01}, {"g", 9.80665}, {"ft/s2", .3048}}},
        {"m/s", {{"m/s", 1.}, {"km/s", 1e3}, {"cm/s", .01}, {"mm/s", 1e-3}, {"ft/s", .3048}}},
        {"degrees",
         {{"degrees", 1.}, {"degree", 1.}, {"deg", 1.}, {"\u00b0", 1.}, {"rad", 57.29577951308232}}},
        {"N/m", {{"N/m", 1.}, {"J/m2", 1.}, {"N/mm", 1e3}, {"kN/m", 1e3}}},
        {"Hz", {{"Hz", 1.}, {"kHz", 1e3}}},
        {"1/s", {{"1/s", 1.}}},
        {"degC", {{"degC", 1.}, {"\u00b0C", 1.}}},
        {"1/K", {{"1/K", 1.}, {"1/degC", 1.}, {"1e-6/K", 1e-6}}},
        {"-", {{"%", .01}, {"-", 1.}}}};
    for (const auto &[si, units] : all)
      for (const auto &[unit, factor] : units)
        expect_close(std::stod(converted("3 " + unit, si)), 3. * factor, 1e-13, "3 " + unit + " in " + si);
    expect_error([&] { converted("21 mm", "Pa"); }, {"Entry \"A/B\"", "Pa", "a unit of length", "GPa"});
    expect_error([&] { converted("21 gpa", "Pa"); }, {"\"gpa\"", "not a unit", "GPa"});
    expect_error([&] { converted("5 m", "-"); }, {"has no unit", "5 m"});
    expect_error([&] { converted("5 m", ""); }, {"has no unit"});
    expect_error([&] { converted("5 Hz", "1/s"); }, {"frequency", "1/s"});
    expect_error([&] { converted("5 m", "parsec"); }, {"parsec", "the number alone"});
  }

  void test_patterns()
  {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"[Double 0...MAX_DOUBLE (inclusive)]", "a number of at least 0"},
        {"[Double -0.99...0.499 (inclusive)]", "a number from -0.99 to 0.499"},
        {"[Double -MAX_DOUBLE...MAX_DOUBLE (inclusive)]", "a number"},
        {"[Double -MAX_DOUBLE...3 (inclusive)]", "a number of at most 3"},
        {"[Integer]", "an integer"},
        {"[Integer range 1...2147483647 (inclusive)]", "an integer of at least 1"},
        {"[Integer range 1...2 (inclusive)]", "an integer from 1 to 2"},
        {"[Bool]", "true or false"},
        {"[Selection tied|FJA|FJB ]", "one of: tied, FJA, FJB"},
        {"[Map of <[Integer range 1...2147483647 (inclusive)]>:<[Selection tied|FJA ]> of length "
         "0...4294967295 "
         "(inclusive)]",
         "a list of pairs \"key: value, key: value\", where the key is an integer of at least 1 and the "
         "value one "
         "of: tied, FJA"},
        {"[List of <[Double 0...1 (inclusive)]> of length 0...3 (inclusive) separated by <;>]",
         "a list \"value; value\", where each is a number from 0 to 1"}};
    for (const auto &c : cases)
      expect(pattern_in_words(c.first) == c.second, c.first + " is " + pattern_in_words(c.first));
    dealii::ParameterHandler prm;
    Scene                    scene;
    scene.add_parameters(prm);
    for (const DeclaredEntry &entry : declared_entries(prm))
    {
      const std::string words = pattern_in_words(entry.pattern);
      expect(words.find_first_of("[]<>|") == std::string::npos && words.find("MAX") == std::string::npos &&
                 words.find("another kind") == std::string::npos,
             entry.name() + " must be " + words);
    }
  }

  void test_nearest()
  {
    expect(edit_distance("crest", "Crest") == 0 && edit_distance("crest", "crst") == 1 &&
               edit_distance("", "abc") == 3,
           "edit_distance");
    expect(nearest_name({"base", "upstream", "crest"}, "up stream") == "upstream", "nearest_name");
  }

  /** The warnings of a scene with this text. */
  std::vector<std::string> warnings_of(const std::string &text)
  {
    std::ofstream("warnings.prm") << text;
    dealii::ParameterHandler prm;
    Scene                    scene;
    read_scene("warnings.prm", {}, scene, prm);
    return scene.warnings;
  }

  void test_warnings()
  {
    dealii::ParameterHandler prm;
    Scene                    scene;
    scene.add_parameters(prm);
    const std::vector<DeclaredEntry> declared = declared_entries(prm);
    for (const std::string &name : entries_with_warnings())
      expect(std::any_of(declared.begin(), declared.end(),
                         [&](const DeclaredEntry &entry) {
                           return entry.name() == name ||
                                  (name.back() == '/' && entry.name().rfind(name, 0) == 0);
                         }),
             "a warning speaks of " + name + ", which there is not");
    // All defaults written out, and every default as a value of its own.
    std::ostringstream all;
    prm.print_parameters(all, dealii::ParameterHandler::PRM);
    expect(warnings_of(all.str()).empty(), "the defaults are warned of");

    const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
        {"subsection Joints\nset Friction = 0.5\nset Model = FJB\nend\n",
         {"Joints/Friction (warnings.prm, line 2) has no effect", "FJB"}},
        {"subsection Joints\nset Friction = 0.5\nset Model = tied\nend\n", {"Joints/Friction", "tied"}},
        {"subsection Joints\nset Friction = 0.5\nset Model = FJB\nset Overrides = 2: FJA\nend\n", {}},
        {"subsection Joints\nset Friction = 0.5\nset Model = KSM\nend\n", {}},
        {"subsection Joints\nsubsection Keys\nset Height = 0.3\nset Friction = 0.4\nend\nend\n",
         {"Joints/Keys/Height (warnings.prm, line 3), Joints/Keys/Friction (warnings.prm, line 4) have no "
          "effect",
          "KSM"}},
        {"subsection Mesh\nset Source = file\nset File = a.msh\nsubsection Arch210\nset Joints = "
         "3\nend\nend\nsubsection Reservoir\nset Water level = 50\nend\n",
         {"Mesh/Arch210/Joints", "Mesh/Source is file"}},
        {"subsection Mesh\nset Source = file\nset File = a.msh\nend\n",
         {"no Reservoir/Water level", "195 m"}},
        {"subsection Mesh\nset File = a.msh\nset Axes = y -x z\nend\n",
         {"Mesh/File", "Mesh/Axes", "Mesh/Source is arch210"}},
        {"subsection Foundation\nset Young's modulus = 2e10\nend\n", {"Young's modulus", "Model is rigid"}},
        {"subsection Foundation\nset Model = massless\nset Boundary = mtf2\nset Young's modulus = "
         "2e10\nend\n",
         {"Foundation/Boundary (warnings.prm, line 3) has no effect", "massless"}},
        {"subsection Motion\nset Source = none\nset Duration = 5\nend\n", {"Motion/Duration", "none"}},
        {"subsection Motion\nset Source = none\nend\n", {}},
        {"subsection Motion\nset Source = file\nset File = a.txt\nset Seed = 3\nend\n",
         {"Motion/Seed", "Motion/Source is file"}},
        {"subsection Motion\nset Unit = g\nend\n", {"Motion/Unit", "artificial"}},
        {"subsection Reservoir\nset Density = 0\nset Water level = 100\nend\n",
         {"Reservoir/Water level", "Reservoir/Density is 0"}},
        {"subsection Reservoir\nset Density = 0\nend\n", {}},
        {"subsection Concrete\nset Young's modulus = 21\nend\n",
         {"Concrete/Young's modulus (warnings.prm, line 2) is 21 Pa", "5e+09 to 6e+10 Pa", "21 GPa"}},
        {"subsection Concrete\nset Young's modulus = 21 GPa\nend\n", {}},
        {"subsection Concrete\nset Young's modulus = 1e6\nend\n", {"1e+06 Pa"}},
        {"subsection Concrete\nset Density = 2.4\nend\n", {"is 2.4 kg/m^3", "1800 to 3000"}},
        {"subsection Motion\nset Peak acceleration = 5.5\nend\n", {"is 5.5 g", "0.005 to 2"}},
        {"subsection Joints\nset Friction = 10\nend\n", {"Joints/Friction", "is 10:", "0.1 to 2"}},
        {"subsection Statics\nset Gravity = 1 g\nend\n", {}},
        {"subsection Statics\nset Gravity = 981\nend\n", {"Statics/Gravity"}},
        {"subsection Statics\nset Gravity = 0\nend\n", {"Statics/Gravity", "is 0 m/s^2"}},
        {"subsection Loads\nset Combinations = odd: weight, water -1, earthquake -1\nset Combination = "
         "odd\nend\n",
         {"Loads/Combination is odd, with water -1:"}},
        {"subsection Reservoir\nset Water level = 150000\nend\n", {"Reservoir/Water level"}}};
    for (const auto &c : cases)
    {
      const std::vector<std::string> warnings = warnings_of(c.first);
      expect(warnings.size() == (c.second.empty() ? 0 : 1), std::to_string(warnings.size()) +
                                                                " warnings of\n" + c.first +
                                                                (warnings.empty() ? "" : warnings[0]));
      for (const std::string &part : c.second)
        expect(warnings[0].find(part) != std::string::npos, "'" + part + "' is missing in: " + warnings[0]);
    }
  }
} // namespace

int main()
{
  return run({{"units", test_units},
              {"patterns", test_patterns},
              {"nearest names", test_nearest},
              {"warnings", test_warnings}});
}
