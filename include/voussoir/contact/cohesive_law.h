// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_cohesive_law_h
#define voussoir_cohesive_law_h

#include <voussoir/contact/joint_law.h>
#include <voussoir/contact/law_parameters.h>

#include <memory>

namespace Voussoir
{
  /** Law cohesive: a bonded joint, grouted or cast, whose tensile strength is lost as it opens; then FJA.
   *
   *  Bonded, the pair is tied, whatever its shear. It cracks where the tensile stress reaches the strength
   * f_t; from then on the stress across it falls with the opening w, f_t (1 - w/w_c), w_c = 2 G_f/f_t (linear
   * softening; Hillerborg, Modeer and Petersson 1976), in a straight line to the origin and back where it
   * closes meanwhile, and there is no shear but friction where it is closed. The bond is lost at w_c; at once
   * where the fracture energy G_f is 0.
   *
   *  Memory: {bonded 0, cracked 1 or lost 2; largest opening since it cracked [m]}. A pair that cracks and is
   * relieved by others in the same step, before it moves, is bonded again; one that slid without opening
   * counts as opened by 1e-8 w_c. Where the time integration takes means over the step, so does the
   * softening: its work is the fracture energy, to round-off.
   *
   *  Elements longer than E G_f/f_t^2 store more energy than the crack takes: there the softening is a drop.
   * Edges where planes of a joint meet are not known to this law. InputError for negative values and other
   * equations. */
  std::unique_ptr<JointLaw> make_cohesive_law(const LawParameters &parameters);

  std::string cohesive_law_warning(const LawParameters &parameters); ///< see joint_law_warning()
} // namespace Voussoir

#endif
