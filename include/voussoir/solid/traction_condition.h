// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef voussoir_traction_condition_h
#define voussoir_traction_condition_h

#include <voussoir/base/tensor3.h>

#include <array>
#include <vector>

namespace Voussoir
{
  /** The stress nearest to a given one among those with known tractions on planes through the point:
   *
   *    minimise (s - s_0) : C^-1 : (s - s_0)  subject to  s n_k = t_k,
   *    s = s_0 + C A^T (A C A^T)^+ (t - A s_0),
   *
   *  C isotropic elasticity, A the tractions of a stress. The strain that is added is sum_k sym(l_k x n_k):
   *  nothing along the planes. With one plane this is plane stress and the known tractions; on an edge the
   *  strain along it remains, at a corner of three planes nothing. Tractions that contradict each other
   *  (t_1 n_2 is not t_2 n_1) are met in the mean of squares. */
  struct TractionCondition
  {
    TractionCondition(double poisson, const std::vector<Vector3> &normals);

    std::array<std::array<double, 6>, 6> of_stress; ///< s by s_0: I - C A^T (A C A^T)^+ A; xx yy zz xy yz zx
    std::vector<std::array<double, 18>>  of_traction; ///< s by t_k, 6 x 3, row by row
  };
} // namespace Voussoir

#endif
