// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/contact/fja_law.h>
#include <voussoir/contact/pair_conditions.h>

#include <algorithm>
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

      Vector3 solve_acceleration(const Matrix3 &H, const Vector3 &b, const Vector3 &w,
                                 const double stick_speed, const PairHistory &history,
                                 const unsigned char active) const override
      {
        const double speed = length(w[1], w[2]);
        if (speed <= stick_speed || !active)
          return solve_impulse(H, b, history, active);
        const double e1 = w[1] / speed, e2 = w[2] / speed, h = H[0] - mu * (H[1] * e1 + H[2] * e2);
        const double normal = h > 0. ? std::max(0., -b[0] / h) : std::max(0., -b[0] / H[0]);
        return {{normal, -mu * normal * e1, -mu * normal * e2}};
      }

      double flat_friction() const override { return mu; }

    protected:
      const double mu;
    };

    /** The same joint with the equations (3b) and (4b) of the paper. The angle of slip is that of the force,
     * which is undefined for an open or unloaded pair. For comparison only; see doc/method.md. */
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

    /** Returns the arrow matrix of the Jordan product with @p x times a 3x3 matrix. */
    Matrix3 arrow_times(const Vector3 &x, const Matrix3 &a)
    {
      Matrix3 b;
      for (unsigned int j = 0; j < 3; ++j)
      {
        b[j] = x[0] * a[j] + x[1] * a[3 + j] + x[2] * a[6 + j];
        b[3 + j] = x[1] * a[j] + x[0] * a[3 + j];
        b[6 + j] = x[2] * a[j] + x[0] * a[6 + j];
      }
      return b;
    }

    /** Returns the inverse of the arrow matrix of @p x times a 3x3 matrix. */
    Matrix3 arrow_inverse_times(const Vector3 &x, const Matrix3 &a)
    {
      const double det = x[0] * x[0] - x[1] * x[1] - x[2] * x[2];
      Matrix3      b;
      for (unsigned int j = 0; j < 3; ++j)
      {
        b[j] = (x[0] * a[j] - x[1] * a[3 + j] - x[2] * a[6 + j]) / det;
        b[3 + j] = (a[3 + j] - x[1] * b[j]) / x[0];
        b[6 + j] = (a[6 + j] - x[2] * b[j]) / x[0];
      }
      return b;
    }

    /** Coulomb's law as a complementarity problem on the second-order cone (De Saxce). The vectors X =
     * rho (u_n + mu |u_t|, mu u_t) and Y = (mu r_n, r_t) must be orthogonal members of the cone. This
     * holds if and only if X + Y = (X o X + Y o Y)^(1/2), with the Jordan product o (Fukushima, Luo
     * and Tseng 2001). */
    class FJASmooth : public FJA
    {
    public:
      using FJA::FJA;

      void evaluate(const Vector3 &force, const Vector3 &gap, const PairHistory &history, const double rho,
                    PairEquations &e) const override
      {
        alart_curnier(force, gap[0], {{gap[1] - history.start[1], gap[2] - history.start[2]}}, mu, rho,
                      e); // sets the state
        const PairState state = e.state;
        e = {};
        if (mu == 0.)
        {
          smooth_normal_condition(force[0], gap[0], rho, e);
          for (unsigned int i = 1; i < 3; ++i)
          {
            e.residual[i] = force[i];
            e.d_force[4 * i] = 1.;
          }
          e.state = state;
          return;
        }
        const double  s1 = gap[1] - history.start[1], s2 = gap[2] - history.start[2], slip = length(s1, s2);
        const Vector3 X = {{rho * (gap[0] + mu * slip), rho * mu * s1, rho * mu * s2}},
                      Y = {{mu * force[0], force[1], force[2]}};
        const double w0 = dot(X, X) + dot(Y, Y), w1 = 2. * (X[0] * X[1] + Y[0] * Y[1]),
                     w2 = 2. * (X[0] * X[2] + Y[0] * Y[2]), w = length(w1, w2);
        const double low = std::sqrt(std::max(0., w0 - w)), high = std::sqrt(w0 + w);
        Vector3      z = {{.5 * (high + low), 0., 0.}};
        if (w > 0.)
          z[1] = .5 * (high - low) * w1 / w, z[2] = .5 * (high - low) * w2 / w;
        for (unsigned int i = 0; i < 3; ++i)
          e.residual[i] = X[i] + Y[i] - z[i];
        const double k1 = slip > 0. ? s1 / slip : 0., k2 = slip > 0. ? s2 / slip : 0.;
        Matrix3      dX = {{rho, rho * mu * k1, rho * mu * k2, 0., rho * mu, 0., 0., 0., rho * mu}},
                dY = {{mu, 0., 0., 0., 1., 0., 0., 0., 1.}};
        Vector3 x = X, y = Y;
        if (!(high > 0.)) // X = Y = 0: an element of the generalised Jacobian
          z = {{1., 0., 0.}}, x = y = {{std::sqrt(.5), 0., 0.}};
        else if (low < 1e-8 * high) // on the boundary of the cone: an element nearby
          z[0] += 1e-8 * high;
        const Matrix3 a = arrow_inverse_times(z, arrow_times(x, dX)),
                      b = arrow_inverse_times(z, arrow_times(y, dY));
        for (unsigned int k = 0; k < 9; ++k)
        {
          e.d_gap[k] = dX[k] - a[k];
          e.d_force[k] = dY[k] - b[k];
        }
        e.state = state;
        e.active = state != PairState::open;
      }
    };
  } // namespace

  std::unique_ptr<JointLaw> make_fja_law(const LawParameters &parameters)
  {
    if (parameters.equations == Equations::paper)
      return std::make_unique<FJAPaper>(parameters.friction);
    if (parameters.equations == Equations::fischer_burmeister)
      return std::make_unique<FJASmooth>(parameters.friction);
    return std::make_unique<FJA>(parameters.friction);
  }
} // namespace Voussoir
