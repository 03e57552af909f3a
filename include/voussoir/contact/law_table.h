// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_law_table_h
#define voussoir_law_table_h

#include <voussoir/contact/joint_law.h>
#include <voussoir/contact/law_parameters.h>

#include <memory>
#include <string>

namespace Voussoir
{
  struct ModelChoices;

  /** Makes the law of the row @p name. Stiffnesses act if the law reads them, or has one surface and @p crosses joints.
   * Throws InputError for an unknown name, for equations that the law does not have, and for invalid parameters. */
  std::unique_ptr<JointLaw> make_joint_law(const std::string &name, const LawParameters &parameters,
                                           bool crosses = false);

  /** Returns whether the law uses the entry, such as "Joints/Friction". Also true if the law is not in the
   * table. */
  bool joint_law_reads(const std::string &name, const std::string &entry);

  /** Returns the names of the laws that read the entry, such as "FJA, KSM". Empty if there is none. */
  std::string joint_laws_with(const std::string &entry);

  /** Returns a warning about parameters of the law that are plausible alone, but not in combination. Empty if
   * there is none, or if the law is not in the table. */
  std::string joint_law_warning(const std::string &name, const LawParameters &parameters);

  /** Returns the laws that may require mean forces, for a message. */
  std::string joint_laws_of_mean_force();

  /** Returns the names of the laws as a ParameterHandler selection, such as "tied|FJA". */
  std::string joint_law_names();

  /** Adds the other laws for all joints. A law is simpler if the present one reads all of its entries. */
  void add_law_choices(const std::string &present, const LawParameters &parameters, ModelChoices &choices);

  /** Returns names and short descriptions of the laws, for the help of the entry "Joints/Model". */
  std::string joint_law_docs();
} // namespace Voussoir

#endif
