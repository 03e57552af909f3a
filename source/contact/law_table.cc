// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/base/names.h>
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
    return row_of(laws, name, "is no joint law", "The laws are:").make(parameters);
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
