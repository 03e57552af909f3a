// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_fja_law_h
#define voussoir_fja_law_h

#include <voussoir/contact/joint_law.h>
#include <voussoir/contact/law_parameters.h>

#include <memory>

namespace Voussoir
{
  /** Makes the law FJA: a flat joint that opens and slips with Coulomb friction. */
  std::unique_ptr<JointLaw> make_fja_law(const LawParameters &parameters);
} // namespace Voussoir

#endif
