// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_free_law_h
#define voussoir_free_law_h

#include <voussoir/contact/joint_law.h>

#include <memory>

namespace Voussoir
{
  /** Makes the law of a joint that is not grouted yet: no force for any gap. Input files cannot select it. */
  std::unique_ptr<JointLaw> make_free_law();
} // namespace Voussoir

#endif
