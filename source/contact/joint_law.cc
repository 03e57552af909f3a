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

  Vector3 JointLaw::stop_normal(const Matrix3 &H, const Vector3 &v, const Vector3 &applied,
                                const unsigned char active) const
  {
    return {{active ? std::max(std::min(0., applied[0]), applied[0] - v[0] / H[0]) : applied[0], applied[1],
             applied[2]}};
  }

  double JointLaw::utilisation(const Vector3 &, const Vector3 &, const PairHistory &) const
  {
    return 0.;
  }

  void JointLaw::apply_event(double *, JointEvent) const {}

  void JointLaw::commit(const Vector3 &, const Vector3 &, const PairHistory &, double *) const {}

  double JointLaw::bond_energy(const Vector3 &, double, const double *) const
  {
    return 0.;
  }
} // namespace Voussoir
