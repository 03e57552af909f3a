// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_traction_condition_h
#define voussoir_traction_condition_h

#include <voussoir/base/tensor3.h>

#include <array>
#include <vector>

namespace Voussoir
{
  /** Correction of a stress so that it has known tractions on planes through the point. The result is the
   * nearest stress in the energy norm:
   *
   *    minimise (s - s_0) : C^-1 : (s - s_0)  subject to  s n_k = t_k,
   *    s = s_0 + C A^T (A C A^T)^+ (t - A s_0).
   *
   * C is isotropic elasticity, and A maps a stress to its tractions. The added strain is sum_k sym(l_k x
   * n_k), with no component parallel to the planes. With one plane the result combines the given in-plane
   * strains with the known tractions. On an edge the strain along the edge remains; at a corner of three
   * planes the tractions determine the stress. Contradictory tractions (t_1 n_2 differs from t_2 n_1) are
   * satisfied in the sense of least squares. */
  struct TractionCondition
  {
    /** @param poisson Poisson's ratio
     * @param normals unit normals of the planes */
    TractionCondition(double poisson, const std::vector<Vector3> &normals);

    std::array<std::array<double, 6>, 6> of_stress; ///< s by s_0: I - C A^T (A C A^T)^+ A; xx yy zz xy yz zx
    std::vector<std::array<double, 18>>  of_traction; ///< s by t_k, 6 x 3, row by row
  };
} // namespace Voussoir

#endif
