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

      /** Entries of section Joints that the law reads; all, if they are not listed. */
      std::optional<Entries> entries = std::nullopt;

      bool lists(const std::string &entry) const
      {
        const auto is_named = [&](const char *name)
        { return entry.rfind(std::string("Joints/") + name, 0) == 0; };
        return entries && std::any_of(entries->begin(), entries->end(), is_named);
      }
    };

    /** All laws. The selection of the entry "Joints/Model", its text and the messages follow from these rows.
     */
    const LawRow laws[] = {
        {"tied", "the monolithic dam", make_tied_law, Entries{}},
        {"FJA", "opens and slides with friction", make_fja_law, Entries{"Friction", "Equations"}},
        {"FJB", "opens, does not slide", make_fjb_law, Entries{"Equations"}},
        {"KSM", "shear keys (Joints/Keys) on a face that opens and slides", make_key_law,
         Entries{"Friction", "Equations", "Keys/"}},
        {"cohesive", "FJA with a bond of the strength Joints/Strength that breaks", make_cohesive_law,
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
