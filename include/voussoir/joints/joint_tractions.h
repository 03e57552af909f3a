// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_tractions_h
#define voussoir_joint_tractions_h

#include <voussoir/solid/structure.h>

namespace Voussoir
{
  class SolidModel;

  /** Forces per area of the pairs. The normal force of a pair is the work of the pressure p on the shape
   * function of its node, f = M p with the mass matrix M of the joint's faces; over the area A of the pair it
   * is a mean, which at an edge of the joint lags behind by a third of an element. One step of
   * p += A^-1 (f - M p) from there takes most of that away. Shear forces stay over the area: they are rougher
   * than that step likes. */
  class JointTractions
  {
  public:
    JointTractions(const SolidModel &model, const Structure &structure);

    /** Of side 1 on side 2 at each pair, in the frame of the pair: compression > 0 [Pa]; @p force: 3 per pair
     * [N]. Nothing where the pair has no force; no tension where its force is none. */
    const std::vector<Vector3> &at(const Unknowns &force);

  private:
    const Structure                                          &structure;
    std::vector<std::vector<std::pair<unsigned int, double>>> mean; ///< rows of A^-1 M: pair, share
    std::vector<double>                                       first;
    std::vector<Vector3>                                      traction;
  };
} // namespace Voussoir

#endif
