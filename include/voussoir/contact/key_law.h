// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_key_law_h
#define voussoir_key_law_h

#include <voussoir/contact/law_parameters.h>
#include <voussoir/contact/surfaces_law.h>

namespace Voussoir
{
  /** Law KSM: a flat face with shear keys. Throws InputError for keys that cannot be. */
  std::unique_ptr<JointLaw> make_key_law(const LawParameters &parameters);

  std::string key_law_warning(const LawParameters &parameters); ///< see joint_law_warning()
} // namespace Voussoir

#endif
