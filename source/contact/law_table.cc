// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/entries.h>
#include <voussoir/base/model_choices.h>
#include <voussoir/base/names.h>
#include <voussoir/contact/cohesive_law.h>
#include <voussoir/contact/elastic_law.h>
#include <voussoir/contact/fja_law.h>
#include <voussoir/contact/fjb_law.h>
#include <voussoir/contact/key_law.h>
#include <voussoir/contact/law_table.h>
#include <voussoir/contact/tied_law.h>

#include <algorithm>

namespace Voussoir
{
  namespace
  {
    struct LawRow
    {
      const char *name, *doc;
      std::unique_ptr<JointLaw> (*make)(const LawParameters &);
      EntryNames entries; ///< of section Joints that the law reads

      /** Addition to the name in the message about JointLaw::needs_mean_force(); null: never needed. */
      const char *mean_force = nullptr;

      /** Returns a warning about parameters that are implausible in combination, or ""; null: no warnings. */
      std::string (*warning)(const LawParameters &) = nullptr;
    };

    /** All laws. The selection and the help of the entry "Joints/Model" and the messages follow from these rows. */
    const LawRow laws[] = {
        {"tied", "no opening and no slip (monolithic dam)", make_tied_law, {}},
        {"FJA",
         "opening, and slip with friction",
         make_fja_law,
         {"Joints/Friction", "Joints/Equations", "Joints/Normal stiffness", "Joints/Tangential stiffness",
          "Joints/Adhesion"},
         " with a stiffness or adhesion"},
        {"FJB",
         "opening, no slip",
         make_fjb_law,
         {"Joints/Equations", "Joints/Normal stiffness", "Joints/Tangential stiffness"},
         " with a stiffness"},
        {"KSM",
         "FJA with shear keys (Joints/Keys)",
         make_key_law,
         {"Joints/Friction", "Joints/Equations", "Joints/Keys/"},
         " (unless \"Joints/Keys/Seat compliance\" is 0)",
         key_law_warning},
        {"cohesive",
         "FJA with a tensile strength (Joints/Strength)",
         make_cohesive_law,
         {"Joints/Friction", "Joints/Equations", "Joints/Strength", "Joints/Fracture energy",
          "Joints/Normal stiffness", "Joints/Tangential stiffness"},
         "",
         cohesive_law_warning}};

    /** Returns the row of a law; null if the law is not in the table. */
    const LawRow *find_row(const std::string &name)
    {
      const auto row =
          std::find_if(std::begin(laws), std::end(laws), [&](const LawRow &l) { return name == l.name; });
      return row == std::end(laws) ? nullptr : row;
    }
  } // namespace

  void LawParameters::add_parameters(Entries &prm)
  {
    using dealii::Patterns::Double;
    prm.add_parameter("Friction", friction, "Coefficient of friction [-].", {.1, 2., true}, Double(0., 1e4));
    prm.add_parameter("Strength", strength, "Tensile strength of the joint [Pa]. Model cohesive only.",
                      {1e5, 6e6, true}, Double(0.));
    prm.add_parameter("Fracture energy", fracture_energy,
                      "Fracture energy of the joint per area [N/m]. Model cohesive only. 0: the strength is "
                      "lost immediately.",
                      {10., 1000., true}, Double(0.));
    prm.add_parameter("Normal stiffness", normal_stiffness,
                      "Stiffness of the joint itself under compression, per area [Pa/m]. 0: rigid.",
                      {1e8, 1e13, true}, Double(0.));
    prm.add_parameter("Tangential stiffness", tangential_stiffness,
                      "Stiffness of the joint itself against slip, per area [Pa/m]. 0: rigid.",
                      {1e8, 1e13, true}, Double(0.));
    prm.add_parameter(
        "Adhesion", adhesion,
        "Shear strength of the joint without pressure [Pa]. A pair that opens loses it. Model FJA only.",
        {1e3, 5e6, true}, Double(0.));
  }

  std::unique_ptr<JointLaw> make_joint_law(const std::string &name, const LawParameters &parameters,
                                           const bool crosses)
  {
    const LawRow             &row = row_of(laws, name, "is no joint law", "The laws are:");
    std::unique_ptr<JointLaw> law = row.make(parameters);
    if (!includes(row.entries, "Joints/Normal stiffness") &&
        !(crosses && row.make != make_tied_law && !law->surfaces_law()))
      return law;
    LawParameters read = parameters;
    if (!includes(row.entries, "Joints/Adhesion"))
      read.adhesion = 0.;
    return make_elastic_law(std::move(law), read);
  }

  bool joint_law_reads(const std::string &name, const std::string &entry)
  {
    const LawRow *row = find_row(name);
    return !row || includes(row->entries, entry);
  }

  std::string joint_law_warning(const std::string &name, const LawParameters &parameters)
  {
    const LawRow *row = find_row(name);
    return row && row->warning ? row->warning(parameters) : "";
  }

  std::string joint_laws_of_mean_force()
  {
    std::string names;
    for (const LawRow &law : laws)
      if (law.mean_force)
        names = law.name + std::string(law.mean_force) + (names.empty() ? "" : " and ") + names;
    return names;
  }

  std::string joint_laws_with(const std::string &entry)
  {
    return listed(laws, [&](const LawRow &law) { return includes(law.entries, entry) ? law.name : ""; });
  }

  void add_law_choices(const std::string &present, const LawParameters &parameters, ModelChoices &choices)
  {
    const EntryNames read = row_of(laws, present, "is no joint law", "The laws are:").entries;
    for (const LawRow &law : laws)
    {
      if (law.name == present ||
          (choices.has_lift_joints && law.name == std::string("KSM"))) // no keys across lifts
        continue;
      std::map<std::string, std::string> entries = {
          {"Joints/Model", law.name},
          {"Joints/Overrides", choices.has_base_joints && law.name == std::string("KSM") ? "base: FJA" : ""}};
      if (includes(law.entries, "Joints/Strength") && parameters.strength == 0.)
        entries.insert({{"Joints/Strength", "1e6"}, {"Joints/Fracture energy", "150"}});
      choices.add("joints", law.name, entries, includes_all(read, law.entries));
    }
  }

  std::string joint_law_names()
  {
    return names_of(laws);
  }

  std::string joint_law_docs()
  {
    return docs_of(laws);
  }
} // namespace Voussoir
