// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/contact/fjb_law.h>
#include <voussoir/contact/pair_conditions.h>

#include <algorithm>

namespace Voussoir
{
  namespace
  {
    constexpr std::array<bool, 3> all = {{true, true, true}}, tangential = {{false, true, true}};

    /** Flat joint that opens and has no slip, whether it is open or closed. Equations (2b), (5), (6). */
    class FJB : public JointLaw
    {
    public:
      void evaluate(const Vector3 &force, const Vector3 &gap, const PairHistory &, const double rho,
                    PairEquations &e) const override
      {
        e = {};
        normal_condition(force[0], gap[0], rho, e);
        no_slip(gap[1], gap[2], rho, e);
        e.state = e.active ? PairState::stick : PairState::open;
      }
      Vector3 error(const Vector3 &force, const Vector3 &gap, const PairHistory &,
                    const double rho) const override
      {
        return {{std::min(force[0], rho * gap[0]), rho * gap[1], rho * gap[2]}};
      }
      Vector3 solve(const Matrix3 &H, const Vector3 &b, const PairHistory &) const override
      {
        const Vector3 f = tie_rows(H, b, all);
        return f[0] > 0. ? f : tie_rows(H, b, tangential);
      }
      Vector3 solve_impulse(const Matrix3 &H, const Vector3 &v, const PairHistory &history,
                            const unsigned char active) const override
      {
        return active ? solve(H, v, history) : tie_rows(H, v, tangential);
      }
      bool is_tangentially_tied() const override { return true; }
    };
  } // namespace

  std::unique_ptr<JointLaw> make_fjb_law(const LawParameters &)
  {
    return std::make_unique<FJB>();
  }
} // namespace Voussoir
