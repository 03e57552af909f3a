// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/contact/fja_law.h>
#include <voussoir/contact/pair_conditions.h>

#include <cmath>

namespace Voussoir
{
  namespace
  {
    /** Flat joint that opens and slides with Coulomb friction. */
    class FJA : public JointLaw
    {
    public:
      explicit FJA(const double friction) : mu(friction) {}

      void evaluate(const Vector3 &force, const Vector3 &gap, const PairHistory &history, const double rho,
                    PairEquations &e) const override
      {
        alart_curnier(force, gap[0], {{gap[1] - history.start[1], gap[2] - history.start[2]}}, mu, rho, e);
      }

      Vector3 error(const Vector3 &force, const Vector3 &gap, const PairHistory &history,
                    const double rho) const override
      {
        return natural_map(force, {{gap[0], gap[1] - history.start[1], gap[2] - history.start[2]}}, mu, rho);
      }

      Vector3 solve(const Matrix3 &H, const Vector3 &b, const PairHistory &history) const override
      {
        return solve_coulomb(H, {{b[0], b[1] - history.start[1], b[2] - history.start[2]}}, mu);
      }

      Vector3 solve_impulse(const Matrix3 &H, const Vector3 &v, const PairHistory &,
                            const unsigned char active) const override
      {
        return active ? solve_coulomb(H, v, mu) : Vector3{};
      }

      double flat_friction() const override { return mu; }

    protected:
      const double mu;
    };

    /** The same joint with the equations (3b) and (4b) of the paper. The angle of slip is that of the force,
     * which is undefined for an open or unloaded pair. For comparison only; see doc/failures.md. */
    class FJAPaper : public FJA
    {
    public:
      using FJA::FJA;

      void evaluate(const Vector3 &force, const Vector3 &gap, const PairHistory &history, const double rho,
                    PairEquations &e) const override
      {
        e = {};
        const bool   closed = normal_condition(force[0], gap[0], rho, e);
        const double g1 = gap[1] - history.start[1], g2 = gap[2] - history.start[2];
        const double p = length(force[1], force[2]), c = p > 0. ? force[1] / p : 1.,
                     s = p > 0. ? force[2] / p : 0.;
        // d(c, s)/d(force_1, force_2)
        const double t11 = p > 0. ? s * s / p : 0., t12 = p > 0. ? -c * s / p : 0.,
                     t22 = p > 0. ? c * c / p : 0.;
        const double radius = closed ? mu * (force[0] - rho * gap[0]) : 0.;
        const double trial = p - rho * (g1 * c + g2 * s), across = rho * (g2 * c - g1 * s);
        // (3b) along (c, s): h3 = p - clip(trial, radius); (4b) normal to it: h4. Residual h3 (c,s)
        // + h4 (-s,c).
        const bool   slips = std::abs(trial) > radius;
        const double sign = trial < 0. ? -1. : 1., h3 = slips ? p - sign * radius : p - trial;
        e.residual[1] = h3 * c - across * s;
        e.residual[2] = h3 * s + across * c;
        // Derivatives of h3 and h4.
        const Vector3 d_trial = {{0., c - rho * (g1 * t11 + g2 * t12), s - rho * (g1 * t12 + g2 * t22)}};
        Vector3       h3_f = {{0., c, s}}, h3_g = {{0., 0., 0.}};
        if (slips && closed)
          h3_f[0] = -sign * mu, h3_g[0] = sign * mu * rho;
        if (!slips)
        {
          for (unsigned int j = 1; j < 3; ++j)
            h3_f[j] -= d_trial[j];
          h3_g[1] = rho * c, h3_g[2] = rho * s;
        }
        const Vector3 h4_f = {{0., rho * (g2 * t11 - g1 * t12), rho * (g2 * t12 - g1 * t22)}},
                      h4_g = {{0., -rho * s, rho * c}};
        const double dc[3] = {0., t11, t12}, ds[3] = {0., t12, t22};
        for (unsigned int j = 0; j < 3; ++j)
        {
          e.d_force[3 + j] = h3_f[j] * c - h4_f[j] * s + h3 * dc[j] - across * ds[j];
          e.d_force[6 + j] = h3_f[j] * s + h4_f[j] * c + h3 * ds[j] + across * dc[j];
          e.d_gap[3 + j] = h3_g[j] * c - h4_g[j] * s;
          e.d_gap[6 + j] = h3_g[j] * s + h4_g[j] * c;
        }
        e.state = !closed ? PairState::open : (slips ? PairState::slip : PairState::stick);
      }
    };
  } // namespace

  std::unique_ptr<JointLaw> make_fja_law(const LawParameters &parameters)
  {
    if (parameters.equations == Equations::paper)
      return std::make_unique<FJAPaper>(parameters.friction);
    return std::make_unique<FJA>(parameters.friction);
  }
} // namespace Voussoir
