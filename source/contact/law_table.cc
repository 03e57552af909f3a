// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/names.h>
#include <voussoir/contact/cohesive_law.h>
#include <voussoir/contact/fja_law.h>
#include <voussoir/contact/fjb_law.h>
#include <voussoir/contact/key_law.h>
#include <voussoir/contact/law_table.h>
#include <voussoir/contact/tied_law.h>

#include <algorithm>
#include <optional>

namespace Voussoir
{
  namespace
  {
    using Entries = std::vector<const char *>;

    struct LawRow
    {
      const char *name, *doc;
      std::unique_ptr<JointLaw> (*make)(const LawParameters &);

      /** Entries of section Joints that the law reads; all of them if not declared. */
      std::optional<Entries> entries = std::nullopt;

      bool lists(const std::string &entry) const
      {
        const auto is_named = [&](const char *name)
        { return entry.rfind(std::string("Joints/") + name, 0) == 0; };
        return entries && std::any_of(entries->begin(), entries->end(), is_named);
      }
    };

    /** All laws. The selection and the help of the entry "Joints/Model" and the messages follow
     * from these rows. */
    const LawRow laws[] = {
        {"tied", "no opening and no slip (monolithic dam)", make_tied_law, Entries{}},
        {"FJA", "opening, and slip with friction", make_fja_law, Entries{"Friction", "Equations"}},
        {"FJB", "opening, no slip", make_fjb_law, Entries{"Equations"}},
        {"KSM", "FJA with shear keys (Joints/Keys)", make_key_law, Entries{"Friction", "Equations", "Keys/"}},
        {"cohesive", "FJA with a tensile strength (Joints/Strength)", make_cohesive_law,
         Entries{"Friction", "Equations", "Strength", "Fracture energy"}}};
  } // namespace

  std::unique_ptr<JointLaw> make_joint_law(const std::string &name, const LawParameters &parameters)
  {
    return row_of(laws, name, "is no joint law", "The laws are:").make(parameters);
  }

  bool joint_law_reads(const std::string &name, const std::string &entry)
  {
    const auto row =
        std::find_if(std::begin(laws), std::end(laws), [&](const LawRow &l) { return name == l.name; });
    return row == std::end(laws) || !row->entries || row->lists(entry);
  }

  std::string joint_laws_with(const std::string &entry)
  {
    std::string names;
    for (const LawRow &law : laws)
      if (law.lists(entry))
        names += (names.empty() ? "" : ", ") + std::string(law.name);
    return names;
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
