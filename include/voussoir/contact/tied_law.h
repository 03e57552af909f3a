// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_tied_law_h
#define voussoir_tied_law_h

#include <voussoir/contact/joint_law.h>
#include <voussoir/contact/law_parameters.h>

#include <memory>

namespace Voussoir
{
  /** Makes the law tied: no opening and no slip, as in a monolithic dam. */
  std::unique_ptr<JointLaw> make_tied_law(const LawParameters &parameters);
} // namespace Voussoir

#endif
