// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_fjb_law_h
#define voussoir_fjb_law_h

#include <voussoir/contact/joint_law.h>
#include <voussoir/contact/law_parameters.h>

#include <memory>

namespace Voussoir
{
  /** Makes the law FJB: a flat joint that opens and has no slip, whether it is open or closed. */
  std::unique_ptr<JointLaw> make_fjb_law(const LawParameters &parameters);
} // namespace Voussoir

#endif
