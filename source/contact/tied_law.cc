// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/contact/pair_conditions.h>
#include <voussoir/contact/tied_law.h>

namespace Voussoir
{
  namespace
  {
    /** No opening and no slip: the monolithic dam. */
    class Tied : public JointLaw
    {
    public:
      void evaluate(const Vector3 &, const Vector3 &gap, const PairHistory &, const double rho,
                    PairEquations &e) const override
      {
        e = {};
        e.residual[0] = rho * gap[0];
        e.d_gap[0] = rho;
        no_slip(gap[1], gap[2], rho, e);
        e.state = PairState::stick;
        e.active = 1;
      }
      Vector3 solve(const Matrix3 &H, const Vector3 &b, const PairHistory &) const override
      {
        return tie_rows(H, b, {{true, true, true}});
      }
      Vector3 solve_impulse(const Matrix3 &H, const Vector3 &v, const PairHistory &,
                            unsigned char) const override
      {
        return tie_rows(H, v, {{true, true, true}});
      }
      bool is_tangentially_tied() const override { return true; }
    };
  } // namespace

  std::unique_ptr<JointLaw> make_tied_law(const LawParameters &)
  {
    return std::make_unique<Tied>();
  }
} // namespace Voussoir
