// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_cohesive_law_h
#define voussoir_cohesive_law_h

#include <voussoir/contact/joint_law.h>
#include <voussoir/contact/law_parameters.h>

#include <memory>

namespace Voussoir
{
  /** Makes the law cohesive: a grouted or cast joint with tensile strength, which becomes FJA when the bond is lost.
   *
   * doc/method.md has the equations. A cracked pair has friction when it is closed, and no shear stress when it is
   * open. The bond is lost at the opening g_c, or immediately if the fracture energy G_f is 0.
   *
   * History variables: {0 bonded, 1 cracked, 2 lost; largest opening since it cracked [m]}. A pair that cracks, and is
   * unloaded by other cracks in the same step before it moves, is bonded again. A closed crack that slips loses its
   * bond.
   *
   * Two elements at the joint that are longer than E G_f/sigma_t^2 store more energy than the crack dissipates; the
   * stress then drops suddenly. The law does not support edges where planes of a joint meet.
   *
   * Throws InputError for a negative strength or fracture energy, and for equations other than "alart-curnier". */
  std::unique_ptr<JointLaw> make_cohesive_law(const LawParameters &parameters);

  /** Returns the warning of joint_law_warning(). */
  std::string cohesive_law_warning(const LawParameters &parameters);
} // namespace Voussoir

#endif
