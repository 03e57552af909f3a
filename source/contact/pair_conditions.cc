// SPDX-License-Identifier: GPL-3.0-or-later
#include <voussoir/contact/pair_conditions.h>

namespace Voussoir
{
  bool normal_condition(const double force, const double opening, const double rho, PairEquations &e)
  {
    const bool closed = force - rho * opening > 0.;
    e.residual[0] = closed ? rho * opening : force;
    (closed ? e.d_gap[0] : e.d_force[0]) = closed ? rho : 1.;
    e.active = closed;
    return closed;
  }

  void no_slip(const double slip_a, const double slip_b, const double rho, PairEquations &e)
  {
    e.residual[1] = rho * slip_a;
    e.residual[2] = rho * slip_b;
    e.d_gap[4] = e.d_gap[8] = rho;
  }

  void alart_curnier(const Vector3 &force, const double opening, const std::array<double, 2> &slip,
                     const double mu, const double rho, PairEquations &e)
  {
    e = {};
    if (!normal_condition(force[0], opening, rho, e))
    {
      for (unsigned int i = 1; i < 3; ++i)
      {
        e.residual[i] = force[i];
        e.d_force[4 * i] = 1.;
      }
      e.state = PairState::open;
      return;
    }
    const double x1 = force[1] - rho * slip[0], x2 = force[2] - rho * slip[1], x = length(x1, x2);
    const double radius = mu * (force[0] - rho * opening);
    if (x <= radius)
    {
      no_slip(slip[0], slip[1], rho, e);
      e.state = PairState::stick;
      return;
    }
    const double e1 = x1 / x, e2 = x2 / x, shrink = radius / x;
    const double g11 = shrink * (1. - e1 * e1), g12 = -shrink * e1 * e2, g22 = shrink * (1. - e2 * e2);
    e.residual[1] = force[1] - radius * e1;
    e.residual[2] = force[2] - radius * e2;
    e.d_force[3] = -mu * e1, e.d_force[4] = 1. - g11, e.d_force[5] = -g12;
    e.d_force[6] = -mu * e2, e.d_force[7] = -g12, e.d_force[8] = 1. - g22;
    e.d_gap[3] = rho * mu * e1, e.d_gap[4] = rho * g11, e.d_gap[5] = rho * g12;
    e.d_gap[6] = rho * mu * e2, e.d_gap[7] = rho * g12, e.d_gap[8] = rho * g22;
    e.state = PairState::slip;
  }

  Vector3 natural_map(const Vector3 &force, const Vector3 &moved, const double mu, const double rho)
  {
    const Vector3 x = {{force[0] - rho * (moved[0] + mu * length(moved[1], moved[2])),
                        force[1] - rho * moved[1], force[2] - rho * moved[2]}};
    const double  t = length(x[1], x[2]);
    if (mu * t <= -x[0])
      return force;
    if (t <= mu * x[0])
      return force - x;
    const double n = (x[0] + mu * t) / (1. + mu * mu);
    return {{force[0] - n, force[1] - mu * n * x[1] / t, force[2] - mu * n * x[2] / t}};
  }

  namespace
  {
    /** Solution with slip at one pair: force_t(k) = -(S + k I)^-1 c, where k = |slip|/|force_t| is the root
     * of |force_t(k)| - mu force_n(k). */
    class Slip
    {
    public:
      struct Trial
      {
        Vector3 force;
        double  excess; ///< 1/(mu force_n) - 1/|force_t|: positive outside the cone
        bool    usable; ///< excess is a number
      };

      Slip(const Matrix3 &H, const Vector3 &b, const double mu)
          : H(H), b(b), mu(mu), s11(H[4] - H[3] * H[1] / H[0]), s12(H[5] - H[3] * H[2] / H[0]),
            s22(H[8] - H[6] * H[2] / H[0]), c1(b[1] - H[3] * b[0] / H[0]), c2(b[2] - H[6] * b[0] / H[0])
      {
      }

      Trial at(const double k) const
      {
        const double det = (s11 + k) * (s22 + k) - s12 * s12;
        const double f1 = -((s22 + k) * c1 - s12 * c2) / det, f2 = -((s11 + k) * c2 - s12 * c1) / det;
        const double n = -(b[0] + H[1] * f1 + H[2] * f2) / H[0], t = length(f1, f2);
        return {{{n, f1, f2}}, 1. / (mu * n) - 1. / t, n > 0. && t > 0.};
      }

      bool outside(const Vector3 &f) const { return length(f[1], f[2]) > mu * f[0]; }

      /** Returns the solution for the root between @p low and @p high. 1/|force_t| is nearly linear in
       * k, so the secant method for 1/|force_t| - 1/(mu force_n) converges in a few steps. Bisection
       * keeps the bracket. */
      Vector3 between(double low, Trial at_low, double high, Trial at_high) const
      {
        int last_side =
            0; // side that moved last; if it moves again, the value of the other side is halved (Illinois)
        for (unsigned int i = 0; i < 200 && high - low > 4e-16 * high; ++i)
        {
          double     middle = .5 * (low + high);
          const bool secant = at_low.usable && at_high.usable && i % 8 != 7;
          if (secant)
          {
            const double step = (high - low) * at_low.excess / (at_low.excess - at_high.excess);
            if (step > 0. && step < high - low)
              middle = low + step;
          }
          const Trial  trial = at(middle);
          const double t = length(trial.force[1], trial.force[2]);
          if (std::abs(t - mu * trial.force[0]) <= 2e-16 * t)
            return trial.force;
          const int side = outside(trial.force) ? -1 : 1;
          if (last_side == side)
            (side < 0 ? at_high : at_low).excess *= .5;
          (side < 0 ? low : high) = middle;
          (side < 0 ? at_low : at_high) = trial;
          last_side = secant ? side : 0;
        }
        return at(high).force;
      }

    private:
      const Matrix3 &H;
      const Vector3 &b;
      const double   mu, s11, s12, s22, c1, c2;
    };
  } // namespace

  /** The pair is open, sticks or slips. A solution exists for every positive definite H. */
  Vector3 solve_coulomb(const Matrix3 &H, const Vector3 &b, const double mu)
  {
    if (b[0] >= 0.)
      return {{0., 0., 0.}};
    if (mu == 0.)
      return {{-b[0] / H[0], 0., 0.}};
    const Slip  slip(H, b, mu);
    double      low = 0., high = H[0] + H[4] + H[8];
    Slip::Trial at_low = slip.at(low);
    if (!slip.outside(at_low.force))
      return at_low.force; // sticks
    Slip::Trial at_high = slip.at(high);
    while (slip.outside(at_high.force) && high < 1e30 * H[0])
    {
      low = high, at_low = at_high;
      high *= 4.;
      at_high = slip.at(high);
    }
    return slip.between(low, at_low, high, at_high);
  }

  Vector3 tie_rows(Matrix3 H, Vector3 b, const std::array<bool, 3> &tied)
  {
    for (unsigned int i = 0; i < 3; ++i)
      if (!tied[i])
      {
        for (unsigned int j = 0; j < 3; ++j)
          H[3 * i + j] = H[3 * j + i] = 0.;
        H[4 * i] = 1.;
        b[i] = 0.;
      }
    const Vector3 f = inverse(H) * b;
    return {{-f[0], -f[1], -f[2]}};
  }
} // namespace Voussoir
