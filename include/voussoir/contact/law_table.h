// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_law_table_h
#define voussoir_law_table_h

#include <voussoir/contact/joint_law.h>
#include <voussoir/contact/law_parameters.h>

#include <memory>
#include <string>

namespace Voussoir
{
  /** The law of that name: tied, FJA, FJB, KSM, cohesive. Throws InputError for an unknown name, and for
   * equations that the law does not have. */
  std::unique_ptr<JointLaw> make_joint_law(const std::string &name, const LawParameters &parameters);

  /** The same, in words. */
  inline std::unique_ptr<JointLaw> make_joint_law(const std::string &name, const double friction,
                                                  const Equations      equations,
                                                  const KeyParameters &keys = KeyParameters())
  {
    return make_joint_law(name, LawParameters(friction, equations, keys));
  }

  /** Does the law use the entry ("Joints/Friction")? Also true of laws that are not in the table. */
  bool joint_law_reads(const std::string &name, const std::string &entry);

  /** The names of the laws that list the entry, "FJA, KSM"; empty if none does. */
  std::string joint_laws_with(const std::string &entry);

  /** A sentence about parameters of the law that are plausible one by one, but not together; empty if there
   * is nothing to say, and of laws that are not in the table. */
  std::string joint_law_warning(const std::string &name, const LawParameters &parameters);

  /** The laws that may need mean forces: "cohesive and KSM (with a compliance of its seats)". */
  std::string joint_laws_of_mean_force();

  /** The names of the laws as a ParameterHandler selection: "tied|FJA|FJB|KSM|cohesive". */
  std::string joint_law_names();

  /** What the laws are, a sentence each, for the entry that selects one. */
  std::string joint_law_docs();
} // namespace Voussoir

#endif
