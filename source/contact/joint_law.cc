// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/contact/joint_law.h>

#include <algorithm>

namespace Voussoir
{
  Vector3 JointLaw::error(const Vector3 &force, const Vector3 &gap, const PairHistory &history,
                          const double rho) const
  {
    PairEquations e;
    evaluate(force, gap, history, rho, e);
    return e.residual;
  }

  Vector3 JointLaw::stop_normal(const Matrix3 &H, const Vector3 &v, const Vector3 &spent,
                                const unsigned char touching) const
  {
    return {
        {touching ? std::max(std::min(0., spent[0]), spent[0] - v[0] / H[0]) : spent[0], spent[1], spent[2]}};
  }

  Vector3 JointLaw::solve_acceleration(const Matrix3 &H, const Vector3 &b, const Vector3 &, double,
                                       const PairHistory &history, const unsigned char touching) const
  {
    return solve_impulse(H, b, history, touching);
  }
} // namespace Voussoir
