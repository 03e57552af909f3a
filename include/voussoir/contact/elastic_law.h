// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_elastic_law_h
#define voussoir_elastic_law_h

#include <voussoir/contact/joint_law.h>
#include <voussoir/contact/law_parameters.h>

#include <memory>

namespace Voussoir
{
  /** Returns the law @p face of a joint with a stiffness and an adhesion, or @p face itself without both.
   *
   * The stiffness is that of the joint itself, such as of a measured rock joint: the gap of the law @p face is
   * gap + D force, with D = diag(1/(k_n A), 1/(k_t A), 1/(k_t A)) and the area A of the pair. So force_n >= 0,
   * gap_n + force_n/(k_n A) >= 0, and slip begins at the friction limit of the elastic tangential force. The elastic
   * slip is remembered. A stiffness of 0 means rigid.
   *
   * The adhesion c moves the friction cone: |force_t| <= c A + mu force_n. The tension is limited to c A/mu. A pair
   * that opens loses its adhesion; slip alone does not.
   *
   * History variables: {0 bonded, 1 adhesion lost; normal and tangential stresses of the last step [Pa]}, then those
   * of @p face.
   *
   * Throws InputError for negative values, for an adhesion without friction or with a bond (cohesive), and for
   * equations other than "alart-curnier". */
  std::unique_ptr<JointLaw> make_elastic_law(std::unique_ptr<JointLaw> face, const LawParameters &parameters);
} // namespace Voussoir

#endif
