// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_key_law_h
#define voussoir_key_law_h

#include <voussoir/contact/law_parameters.h>
#include <voussoir/contact/surfaces_law.h>

namespace Voussoir
{
  /** Makes the law KSM: a flat face with trapezoidal shear keys. Throws InputError for keys with an
   * impossible geometry or friction, and for equations other than "alart-curnier". */
  std::unique_ptr<JointLaw> make_key_law(const LawParameters &parameters);

  /** Returns the warning of joint_law_warning(). */
  std::string key_law_warning(const LawParameters &parameters);
} // namespace Voussoir

#endif
