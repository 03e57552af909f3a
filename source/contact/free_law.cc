// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/contact/free_law.h>

namespace Voussoir
{
  namespace
  {
    class Free : public JointLaw
    {
    public:
      void evaluate(const Vector3 &force, const Vector3 &, const PairHistory &, double,
                    PairEquations &e) const override
      {
        e = {};
        e.residual = force;
        for (unsigned int c = 0; c < 3; ++c)
          e.d_force[4 * c] = 1.;
        e.state = PairState::open;
      }
      Vector3 solve(const Matrix3 &, const Vector3 &, const PairHistory &) const override { return {}; }
      Vector3 solve_impulse(const Matrix3 &, const Vector3 &, const PairHistory &,
                            unsigned char) const override
      {
        return {};
      }
    };
  } // namespace

  std::unique_ptr<JointLaw> make_free_law()
  {
    return std::make_unique<Free>();
  }
} // namespace Voussoir
