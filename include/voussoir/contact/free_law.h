// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_free_law_h
#define voussoir_free_law_h

#include <voussoir/contact/joint_law.h>

#include <memory>

namespace Voussoir
{
  /** No force whatever the gap: a joint that is not grouted yet. Not a choice of scenes. */
  std::unique_ptr<JointLaw> make_free_law();
} // namespace Voussoir

#endif
