// SPDX-License-Identifier: GPL-3.0-or-later
// What users write into scenes: units, patterns in words, entries without effect, implausible values.

#include "testing.h"

#include <voussoir/app/scene_warnings.h>
#include <voussoir/base/nearest_name.h>
#include <voussoir/base/units.h>
#include <voussoir/contact/law_table.h>
#include <voussoir/dam/load_table.h>

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
         {{"m/s2", 1.},
          {"m/s/s", 1.},
          {"cm/s2", .01},
          {"cm/sec/sec", .01},
          {"mm/s2", 1e-3},
          {"gal", .01},
          {"Gal", .01},
          {"g", 9.80665},
          {"ft/s2", .3048}}},
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
    Entries prm;
    Scene   scene;
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
    Entries prm;
    Scene   scene;
    read_scene("warnings.prm", {}, scene, prm);
    std::vector<std::string> texts;
    for (const Warning &warning : scene.warnings)
      texts.push_back(warning.text);
    return texts;
  }

  /** A scene and the parts of each warning that it has, in any order of the warnings. */
  struct Warned
  {
    std::string              scene;
    std::vector<std::string> first = {}, second = {};
  };

  void expect_warnings(const std::vector<Warned> &cases)
  {
    for (const Warned &c : cases)
    {
      const std::vector<std::string> warnings = warnings_of(c.scene);
      std::string                    all;
      for (const std::string &warning : warnings)
        all += warning + "\n";
      expect(warnings.size() == std::size_t(!c.first.empty()) + !c.second.empty(),
             std::to_string(warnings.size()) + " warnings of\n" + c.scene + all);
      for (const auto &parts : {c.first, c.second})
        expect(parts.empty() ||
                   std::any_of(warnings.begin(), warnings.end(),
                               [&](const std::string &warning)
                               {
                                 return std::all_of(parts.begin(), parts.end(),
                                                    [&](const std::string &part)
                                                    { return warning.find(part) != std::string::npos; });
                               }),
               "'" + (parts.empty() ? "" : parts[0]) + "' ... is missing in\n" + all);
    }
  }

  void test_warnings()
  {
    Entries prm;
    Scene   scene;
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
    expect(warnings_of(all.str()).empty(), "the defaults produce warnings");

    std::ofstream("warnings.prm") << "subsection Joints\nset Friction = 0.5\nset Model = FJB\nend\n"
                                     "subsection Concrete\nset Density = 2.4\nend\n";
    Entries of_classes;
    read_scene("warnings.prm", {}, scene, of_classes);
    expect(scene.warnings.size() == 2 && scene.warnings[0].kind == Warning::Kind::physics &&
               scene.warnings[0].place == "warnings.prm, line 6" &&
               scene.warnings[1].kind == Warning::Kind::input &&
               scene.warnings[1].place == "warnings.prm, line 2",
           "class and place of warnings");

    const std::vector<Warned> cases = {
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
         {"Mesh/Arch210/Joints", "Mesh/Source is not arch210"}},
        {"subsection Mesh\nset Source = file\nset File = a.msh\nend\n",
         {"no Reservoir/Water level", "195 m"}},
        {"subsection Mesh\nset File = a.msh\nset Axes = y -x z\nend\n",
         {"Mesh/File", "Mesh/Axes", "Mesh/Source is not file"}},
        {"subsection Foundation\nset Young's modulus = 2e10\nend\n", {"Young's modulus", "Model is rigid"}},
        {"subsection Foundation\nset Model = massless\nset Boundary = mtf2\nset Young's modulus = "
         "2e10\nend\n",
         {"Foundation/Boundary (warnings.prm, line 3) has no effect", "massless"}},
        {"subsection Motion\nset Source = none\nset Duration = 5\nend\n", {"Motion/Duration", "none"}},
        {"subsection Motion\nset Source = none\nend\n", {}},
        {"subsection Motion\nset Source = file\nset File = a.txt\nset Seed = 3\nend\n",
         {"Motion/Seed", "Motion/Source is file"}},
        {"subsection Motion\nset Unit = g\nend\n", {"Motion/Unit", "artificial"}},
        {"subsection Motion\nset Match = true\nset Baseline = linear\nend\n",
         {"Motion/Match", "Motion/Baseline", "have no effect", "artificial"}},
        {"subsection Motion\nset Sequence = 1; 2\nset Seed = 3\nend\n", {"Motion/Seed", "Motion/Sequence"}},
        {"subsection Motion\nset Source = file\nset File = a.txt\nset Unit = g\nset Vertical ratio = 0.5\nend\n",
         {"Motion/Vertical ratio", "Motion/Target spectrum"}},
        {"subsection Motion\nset Rest = 100\nend\n", {"Motion/Rest", "is 100", "1 to 60"}},
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
         {"Loads/Combination is odd, with water -1."}},
        {"subsection Reservoir\nset Water level = 150000\nend\n", {"Reservoir/Water level"}}};
    expect_warnings(cases);
  }

  /** Zones and tables have the usual ranges of the entries, where they are used. */
  void test_sources()
  {
    std::ofstream("kelvin.csv") << "day,upstream,downstream\n0,283,290\n100,288,21\n200,5,6\n";
    const auto zone = [](const std::string &section, const std::string &text)
    { return "subsection " + section + "\nset Zones = heel: " + text + "\nend\n"; };
    const auto rock = [&](const std::string &model, const std::string &text)
    { return "subsection Foundation\nset Model = " + model + "\nset Zones = fault: " + text + "\nend\n"; };
    const auto list = [](const std::string &section, const std::string &entry)
    { return "subsection " + section + "\nset " + entry + "\nend\n"; };
    std::ofstream("mass.csv") << "0,0\n200,150\n";
    const std::string wedge =
        "wedge,plane,x,y,z,dip,dip direction,area,friction,cohesion,uplift,volume,density\n"
        "left,bottom,0,0,0,30,90,";
    std::ofstream("usual.csv") << wedge << "500,0.7,1e5,0,9000,2600\n";
    std::ofstream("odd.csv") << wedge << "500,0.7,0.2,0,9000,26\n"; // in MPa, kN/m^3
    const auto table = [](const std::string &day, const std::string &more)
    {
      return "subsection Loads\nsubsection Temperature\nset Table = kelvin.csv\nset Day = " + day +
             "\nend\n" + more + "end\n";
    };
    expect_warnings({
        {zone("Concrete", "28 0.2 2400"),
         {"Concrete/Zones: zone heel, Young's modulus is 28 Pa", "5e+09 to 6e+10 Pa", "21 GPa"}},
        {zone("Concrete", "280 GPa 0.2 2400"), {"2.8e+11 Pa"}},
        {zone("Concrete", "28 GPa 0.2 24.5"), {"the density is 24.5 kg/m^3", "1800 to 3000"}},
        {zone("Concrete", "28 GPa 0.45 2400"), {"Poisson's ratio is 0.45:", "0.1 to 0.3"}},
        {zone("Concrete", "28 GPa 0.2 2450"), {}},
        {rock("rock", "2e11 0.2 2700"), {"Foundation/Zones: zone fault, Young's modulus", "2e+11 Pa"}},
        {rock("rock", "2e10 0.2 27"), {"the density is 27 kg/m^3"}},
        {rock("massless", "2e10 0.2 27"), {}}, // is not used
        {list("Joints", "Initial gaps = 1: 2, 2: 1 mm"),
         {"Joints/Initial gaps: 1 is 2 m: usual is 1e-05 to 0.05 m", "20 cm"}},
        {list("Joints", "Initial gaps = 1: 2 mm, 2: 0"), {}},
        {list("Joints", "Model = KSM\nsubsection Keys\nset Clearances = 1: 2\nend"),
         {"Joints/Keys/Clearances: 1 is 2 m: usual is 0 to 0.1 m"}},
        {list("Dynamics", "Initial velocity = monolith 1: 0 50 0"),
         {"Dynamics/Initial velocity: the largest velocity is 50 m/s"}},
        {list("Statics", "Stages = cut 1 by 10"), {"Statics/Stages: width of the cut of 1 is 10 m"}},
        {list("Statics", "Stages = grout 90 at 0.5, cut 1 by 10 mm"),
         {"Statics/Stages: pressure of grout 90 is 0.5 Pa: usual is 10000 to 5e+06 Pa"}},
        {list("Statics", "Stages = grout 90, grout 100 at 0.5 MPa, cut 1 by 10 mm"), {}},
        {list("Loads", "Crest line = 30 0 -40"), {"Loads/Crest line: the force per length is 50 N/m"}},
        {list("Loads", "Crest line = 0 0 -5e4"), {}},
        {list("Loads", "Concentrated = crane: 0 0 9 0 0 -300; gate: 0 0 9 2e6 0 0"),
         {"Loads/Concentrated: crane is 300 N"}},
        {list("Reservoir", "Model = added mass table\nset Table = mass.csv"),
         {"Reservoir/Table: largest added mass of mass.csv is 150 kg/m^2: usual is 1000 to 1e+06 kg/m^2"}},
        {list("Limits", "Wedges = usual.csv\nset Wedge safety = 1.2"), {}},
        {list("Limits", "Wedges = odd.csv"),
         {"Limits/Wedges: density of wedge left is 26 kg/m^3: usual is 2000 to 3500 kg/m^3."},
         {"Limits/Wedges: cohesion of plane bottom of wedge left is 0.2 Pa: usual is 1000 to 1e+07 Pa."}},
        {list("Limits", "Wedge safety = 1.2"),
         {"Limits/Wedge safety", "has no effect: there is no Limits/Wedges"}},
        {table("200", ""), {}},
        {table("50", "subsection Silt\nend\n"),
         {"Loads/Temperature/Table (kelvin.csv): Upstream face on day 50 is 285.5 degC", "-40 to 50 degC",
          "273.15"},
         {"Downstream face on day 50 is 155.5 degC: usual is -40 to 60 degC."}},
        {table("200", "end\nsubsection Statics\nset Stages = day 0, day 100, day 200\n"),
         {"Upstream face on day 100 is 288 degC"},
         {"Downstream face on day 0 is 290 degC"}},
        {table("50", "set Combination = cold\nset Combinations = cold: weight\n"), {}}, // is not used
        {table("900", ""), {}},                                                         // an error later
    });
  }

  /** Entries that are plausible one by one. */
  void test_relations()
  {
    const std::string
        loads = "subsection Loads\n",
        end = "end\n",
        named = "set Combination = flood\nset Combinations = flood: weight, water, silt, crest line\n";
    const auto level = [&](const std::string &load, const std::string &z, const std::string &more = "")
    { return loads + "subsection " + load + "\nset Level = " + z + "\n" + more + end + end; };
    const auto keys = [](const std::string &angle)
    {
      return "subsection Joints\nset Model = KSM\nset Friction = 0.4\nsubsection Keys\nset Flank angle = " +
             angle + "\nend\nend\n";
    };
    expect_warnings({
        {level("Tail water", "50"), {}},
        {level("Tail water", "195"), {}},
        {level("Tail water", "200"),
         {"Loads/Tail water/Level is 200 m, above the reservoir (Reservoir/Water level is 195 m)"}},
        {level("Tail water", "200") + "subsection Reservoir\nset Density = 0\nend\n", {}},
        {level("Tail water", "50", "set Density = 10\n"),
         {"Loads/Tail water/Density (warnings.prm, line 4) is 10 kg/m^3"}},
        {level("Silt", "60"), {}},
        {level("Silt", "196"), {"Loads/Silt/Level is 196 m, above the reservoir", "under water"}},
        {loads + named + end,
         {"flood contains loads that are not defined: silt, crest line", "Loads/Silt/Level",
          "Loads/Crest line"}},
        {loads + "set Crest line = 0 0 -1e4\n" + named + "subsection Silt\nset Level = 60\nend\n" + end, {}},
        {loads + "set Combination = extreme\n" + end, {}},
        {keys("0.5"), {"Joints/Keys/Flank angle", "0.5 degrees: usual is 10 to 80 degrees", "0.5 rad"}},
        {keys("0"), {}},
        {keys("45"), {}},
    });
  }

  /** The last value of an entry in a file is used. An included file may be overridden. */
  void test_twice()
  {
    std::ofstream("included.prm") << "subsection Joints\nset Friction = 0.7\nend\n";
    const std::string other = "subsection Joints\nset Friction = 0.6\nend\n";
    expect_warnings({
        {other + "subsection Joints\nset Friction = 0.5\nend\n",
         {"Joints/Friction is in the file twice, warnings.prm, line 2 and warnings.prm, line 5", "0.5"}},
        {"include included.prm\n" + other, {}},
        {"include included.prm\ninclude included.prm\n", {}},
    });
    std::ofstream("double.prm") << "include included.prm\n" << other << other;
    expect_warnings(
        {{"include double.prm\n" + other, {"Joints/Friction is in the file twice, double.prm, line 3"}}});
    Entries prm;
    Scene   scene;
    read_scene("included.prm", {"Joints/Friction=0.5", "Joints/Friction=0.4"}, scene, prm);
    expect(scene.warnings.empty() && scene.joints.friction == .4, "twice by --set");
  }

  /** A removed entry produces a warning. */
  void test_removed()
  {
    for (const std::string value : {"true", "false"})
      expect_warnings(
          {{"subsection Dynamics\nset Error estimate = " + value + "\nend\n",
            {"warnings.prm, line 2", "Dynamics/Error estimate", "was removed", "voussoir accuracy"}}});
    expect_warnings({{"subsection Contact\nset Method = newton\nend\n", {"Contact/Method", "was removed"}}});
  }

  /** A law that is in no table may use any entry of the joints. */
  void test_own_law()
  {
    Entries prm;
    Scene   scene;
    scene.add_parameters(prm);
    std::vector<WrittenEntry> entries;
    for (const DeclaredEntry &declared : declared_entries(prm))
      if (declared.name() == "Joints/Friction" || declared.name() == "Joints/Keys/Height")
        entries.push_back({declared, "0.5", "a.prm, line 1"});
    scene.joints.model = "no such law";
    expect(scene_warnings(scene, entries, prm.usual_ranges()).empty(),
           "an entry of a law of one's own is said to have no effect");
    scene.joints.model = "FJB";
    expect(scene_warnings(scene, entries, prm.usual_ranges()).size() == 2,
           "two entries without effect, of different laws");
    scene.joints.overrides["2"] = "no such law";
    expect(scene_warnings(scene, entries, prm.usual_ranges()).empty(), "a law of one's own in one joint");
  }

  /** Ranges are declared with the entries, in all subsections. */
  void test_usual_ranges()
  {
    Entries prm;
    Scene   scene;
    scene.add_parameters(prm);
    const UsualRanges &usual = prm.usual_ranges();
    expect(usual.size() >= 81, "the number of usual ranges");
    for (const auto &[name, range] : usual)
      expect(range.low < range.high, "the usual range of " + name);
    for (const char *name : {"Mesh/Arch210/Rock/Depth", "Concrete/Density", "Joints/Friction",
                             "Joints/Keys/Friction", "Loads/Silt/Density", "Limits/Slip"})
      expect(usual.count(name) == 1, std::string("the usual range of ") + name);
    const UsualRange &strength = usual.at("Joints/Strength");
    expect(strength.low == 1e5 && strength.high == 6e6 && strength.or_zero, "the usual strength of a bond");
  }

  /** The default combination contains all loads of the table. By default only the staged weight acts. */
  void test_loads()
  {
    const LoadParameters loads;
    std::string          all;
    for (const LoadRow &load : load_table())
      all += std::string(load.name) + ", ";
    expect(loads.combinations.at("extreme") == all + "earthquake", loads.combinations.at("extreme"));
    Scene scene;
    scene.reservoir.density = 0.;
    for (const LoadRow &load : load_table())
      expect(load.acts(scene) == (load.is_staged != nullptr),
             std::string("by default a dam without water has the load ") + load.name);
  }

  /** The laws read exactly the entries of their rows. */
  void test_entries_of_laws()
  {
    const std::vector<std::pair<std::string, std::function<void(LawParameters &)>>> changes = {
        {"Joints/Friction", [](LawParameters &p) { p.friction = .3; }},
        {"Joints/Strength", [](LawParameters &p) { p.strength = 9e5; }},
        {"Joints/Fracture energy", [](LawParameters &p) { p.fracture_energy = 9.; }},
        {"Joints/Keys/Height", [](LawParameters &p) { p.keys.height = .05; }}};
    LawParameters standard(.8);
    standard.strength = 1e6;
    standard.fracture_energy = 100.;
    const auto forces = [](const std::string &name, const LawParameters &p)
    {
      const auto          law = make_joint_law(name, p);
      std::vector<double> memory(law->n_memory());
      if (name == "cohesive")
        memory = {1., 2e-5}; // cracked, and open once
      std::vector<double> all;
      for (const bool opens : {false, true})
      {
        PairHistory past(Vector3{{opens ? .1 : 0., 0., 0.}});
        past.memory = memory.data();
        const Matrix3 H = {{1e-9, 0., 0., 0., 1e-9, 0., 0., 0., 1e-9}};
        for (const double normal : {-1e-4, 1e-4, .1})
          for (const double f : law->solve(H, {{normal, 3e-4, 1e-4}}, past))
            all.push_back(f);
      }
      return all;
    };
    for (const std::string name : {"tied", "FJA", "FJB", "KSM", "cohesive"})
      for (const auto &[entry, change] : changes)
      {
        LawParameters other = standard;
        change(other);
        const bool differs = forces(name, other) != forces(name, standard);
        expect(differs == joint_law_reads(name, entry), "the law " + name + " reads " + entry);
        expect(differs == (joint_laws_with(entry).find(name) != std::string::npos),
               "the law " + name + " is among those with " + entry);
      }
  }
} // namespace

int main()
{
  return run({{"units", test_units},
              {"patterns", test_patterns},
              {"nearest names", test_nearest},
              {"warnings", test_warnings},
              {"zones and tables", test_sources},
              {"relations", test_relations},
              {"entries twice", test_twice},
              {"removed entries", test_removed},
              {"a law of one's own", test_own_law},
              {"usual ranges", test_usual_ranges},
              {"loads", test_loads},
              {"entries of laws", test_entries_of_laws}});
}
