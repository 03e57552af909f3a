// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_joint_tractions_h
#define voussoir_joint_tractions_h

#include <voussoir/solid/structure.h>

namespace Voussoir
{
  class SolidModel;

  /** Tractions of the joints from the joint forces.
   *
   * The normal force of a pair is the work of the pressure p on the shape function of its node: f = M p with
   * the mass matrix M of the joint faces. The quotient f/A with the tributary area A is a mean value. At an
   * edge of the joint it has an error of a third of an element. One correction step p += A^-1 (f - M p) from
   * p = f/A removes most of this error. Shear tractions are not corrected, because they are
   * not smooth enough. */
  class JointTractions
  {
  public:
    /** Computes A^-1 M. @p structure must outlive the object. */
    JointTractions(const SolidModel &model, const Structure &structure);

    /** Returns the traction of side 1 on side 2 at each pair, in the frame of the pair; compression is
     * positive [Pa]. @p force: three values per pair [N]. The correction keeps the sign of a normal
     * traction and at most doubles it, so that a force of the size of round-off has no effect. */
    const std::vector<Vector3> &at(const Unknowns &force);

  private:
    const Structure                                          &structure;
    std::vector<std::vector<std::pair<unsigned int, double>>> mean;  ///< rows of A^-1 M: pair, factor
    std::vector<double>                                       first; ///< uncorrected normal traction [Pa]
    std::vector<Vector3>                                      traction;
  };
} // namespace Voussoir

#endif
