// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/error.h>
#include <voussoir/contact/cohesive_law.h>
#include <voussoir/contact/fja_law.h>
#include <voussoir/contact/fjb_law.h>
#include <voussoir/contact/key_law.h>
#include <voussoir/contact/law_table.h>
#include <voussoir/contact/tied_law.h>

namespace Voussoir
{
  namespace
  {
    struct LawRow
    {
      const char *name, *doc;
      std::unique_ptr<JointLaw> (*make)(const LawParameters &);
    };

    /** All laws. The selection of the entry "Joints/Model", its text and the messages follow from these rows.
     */
    const LawRow laws[] = {
        {"tied", "the monolithic dam", make_tied_law},
        {"FJA", "opens and slides with friction", make_fja_law},
        {"FJB", "opens, does not slide", make_fjb_law},
        {"KSM", "shear keys (Joints/Keys) on a face that opens and slides", make_key_law},
        {"cohesive", "FJA with a bond of the strength Joints/Strength that breaks", make_cohesive_law}};
  } // namespace

  std::unique_ptr<JointLaw> make_joint_law(const std::string &name, const LawParameters &parameters)
  {
    for (const LawRow &law : laws)
      if (name == law.name)
        return law.make(parameters);
    throw InputError("There is no joint law \"" + name + "\". The laws are: " + joint_law_names() + ".");
  }

  std::string joint_law_names()
  {
    std::string names;
    for (const LawRow &law : laws)
      names += (names.empty() ? "" : "|") + std::string(law.name);
    return names;
  }

  std::string joint_law_docs()
  {
    std::string text;
    for (const LawRow &law : laws)
      text += (text.empty() ? "" : "; ") + std::string(law.name) + ": " + law.doc;
    return text;
  }
} // namespace Voussoir
