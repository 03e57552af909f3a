#include <voussoir/error.h>
#include <voussoir/joint_law.h>

#include <algorithm>
#include <cmath>

namespace Voussoir
{
  namespace
  {
    double length(const double x, const double y)
    {
      return std::sqrt(x * x + y * y);
    }

    /** Forces that keep the rows of the tangential components at zero jump. */
    Vector3 tangential_tie(const Matrix3 &H, const Vector3 &b)
    {
      const double det = H[4] * H[8] - H[5] * H[7];
      return {{0., -(H[8] * b[1] - H[5] * b[2]) / det, -(H[4] * b[2] - H[7] * b[1]) / det}};
    }

    Vector3 full_tie(const Matrix3 &H, const Vector3 &b)
    {
      const Vector3 f = inverse(H) * b;
      return {{-f[0], -f[1], -f[2]}};
    }

    /** The normal condition, equation (2b): force_n = max(0, force_n - rho gap_n). Returns whether it is
     * closed. */
    bool normal_condition(const Vector3 &force, const Vector3 &gap, const double rho, PairEquations &e)
    {
      const bool closed = force[0] - rho * gap[0] > 0.;
      e.residual[0] = closed ? rho * gap[0] : force[0];
      (closed ? e.d_gap[0] : e.d_force[0]) = closed ? rho : 1.;
      return closed;
    }

    /** No slip: equations (5) and (6). */
    void no_slip(const Vector3 &gap, const double rho, PairEquations &e)
    {
      for (unsigned int i = 1; i < 3; ++i)
      {
        e.residual[i] = rho * gap[i];
        e.d_gap[4 * i] = rho;
      }
    }

    /** Both directions bilateral: the monolithic dam. */
    class Tied : public JointLaw
    {
    public:
      PairState evaluate(const Vector3 &, const Vector3 &gap, const double rho,
                         PairEquations &e) const override
      {
        e = {{{rho * gap[0], 0., 0.}}, {}, {}};
        e.d_gap[0] = rho;
        no_slip(gap, rho, e);
        return PairState::stick;
      }
      Vector3 solve(const Matrix3 &H, const Vector3 &b, bool) const override { return full_tie(H, b); }
      bool    is_tangentially_tied() const override { return true; }
    };

    /** Flat joint that opens and does not slip, open or closed. Equations (2b), (5), (6). */
    class FJB : public JointLaw
    {
    public:
      PairState evaluate(const Vector3 &force, const Vector3 &gap, const double rho,
                         PairEquations &e) const override
      {
        e = {};
        const bool closed = normal_condition(force, gap, rho, e);
        no_slip(gap, rho, e);
        return closed ? PairState::stick : PairState::open;
      }
      Vector3 solve(const Matrix3 &H, const Vector3 &b, const bool closed) const override
      {
        const Vector3 f = closed ? full_tie(H, b) : Vector3{{-1., 0., 0.}};
        return f[0] > 0. ? f : tangential_tie(H, b);
      }
      bool is_tangentially_tied() const override { return true; }
    };

    /** Flat joint that opens and slides with Coulomb friction. Equations (2b), (3b), (4b), the angle of slip
     * taken from the trial force x = force_t - rho gap_t: then (3b) and (4b) together are the projection of x
     * on the disc of radius mu max(0, force_n - rho gap_n) (Alart and Curnier 1991), which is Lipschitz
     * everywhere. */
    class FJA : public JointLaw
    {
    public:
      explicit FJA(const double friction) : mu(friction) {}

      PairState evaluate(const Vector3 &force, const Vector3 &gap, const double rho,
                         PairEquations &e) const override
      {
        e = {};
        if (!normal_condition(force, gap, rho, e))
        {
          for (unsigned int i = 1; i < 3; ++i)
          {
            e.residual[i] = force[i];
            e.d_force[4 * i] = 1.;
          }
          return PairState::open;
        }
        const double x1 = force[1] - rho * gap[1], x2 = force[2] - rho * gap[2], x = length(x1, x2);
        const double radius = mu * (force[0] - rho * gap[0]);
        if (x <= radius)
        {
          no_slip(gap, rho, e);
          return PairState::stick;
        }
        const double e1 = x1 / x, e2 = x2 / x, shrink = radius / x;
        const double g11 = shrink * (1. - e1 * e1), g12 = -shrink * e1 * e2, g22 = shrink * (1. - e2 * e2);
        e.residual[1] = force[1] - radius * e1;
        e.residual[2] = force[2] - radius * e2;
        e.d_force[3] = -mu * e1, e.d_force[4] = 1. - g11, e.d_force[5] = -g12;
        e.d_force[6] = -mu * e2, e.d_force[7] = -g12, e.d_force[8] = 1. - g22;
        e.d_gap[3] = rho * mu * e1, e.d_gap[4] = rho * g11, e.d_gap[5] = rho * g12;
        e.d_gap[6] = rho * mu * e2, e.d_gap[7] = rho * g12, e.d_gap[8] = rho * g22;
        return PairState::slip;
      }

      /** Open, stick, or slip with force_t(k) = -(S + k I)^-1 c, where k = |slip|/|force_t| is the root of a
       *  decreasing function: found by bisection, which cannot fail for H positive definite. */
      Vector3 solve(const Matrix3 &H, const Vector3 &b, const bool closed) const override
      {
        if (!closed || b[0] >= 0.)
          return {{0., 0., 0.}};
        const Vector3 stick = full_tie(H, b);
        if (stick[0] >= 0. && length(stick[1], stick[2]) <= mu * stick[0])
          return stick;
        if (mu == 0.)
          return {{-b[0] / H[0], 0., 0.}};

        const double s11 = H[4] - H[3] * H[1] / H[0], s12 = H[5] - H[3] * H[2] / H[0],
                     s22 = H[8] - H[6] * H[2] / H[0];
        const double c1 = b[1] - H[3] * b[0] / H[0], c2 = b[2] - H[6] * b[0] / H[0];
        const auto   force = [&](const double k) -> Vector3
        {
          const double det = (s11 + k) * (s22 + k) - s12 * s12;
          const double f1 = -((s22 + k) * c1 - s12 * c2) / det, f2 = -((s11 + k) * c2 - s12 * c1) / det;
          return {{-(b[0] + H[1] * f1 + H[2] * f2) / H[0], f1, f2}};
        };
        const auto outside = [&](const Vector3 &f) { return length(f[1], f[2]) > mu * f[0]; };
        double     low = 0., high = H[0] + H[4] + H[8];
        while (outside(force(high)) && high < 1e30 * H[0])
          high *= 4.;
        for (unsigned int i = 0; i < 200 && high - low > 1e-16 * high; ++i)
        {
          const double middle = .5 * (low + high);
          (outside(force(middle)) ? low : high) = middle;
        }
        return force(high);
      }

      Vector3 solve_acceleration(const Matrix3 &H, const Vector3 &b, const Vector3 &w, const double still,
                                 const bool closed) const override
      {
        const double speed = length(w[1], w[2]);
        if (speed <= still || !closed)
          return solve(H, b, closed);
        const double e1 = w[1] / speed, e2 = w[2] / speed, h = H[0] - mu * (H[1] * e1 + H[2] * e2);
        const double normal = h > 0. ? std::max(0., -b[0] / h) : std::max(0., -b[0] / H[0]);
        return {{normal, -mu * normal * e1, -mu * normal * e2}};
      }

    protected:
      const double mu;
    };

    /** The same joint by the paper's own equations (3b), (4b): the angle of slip is that of the force, which
     * is undefined at an open or unloaded pair. For comparison only; see doc/method.md. */
    class FJAPaper : public FJA
    {
    public:
      using FJA::FJA;

      PairState evaluate(const Vector3 &force, const Vector3 &gap, const double rho,
                         PairEquations &e) const override
      {
        e = {};
        const bool   closed = normal_condition(force, gap, rho, e);
        const double p = length(force[1], force[2]), c = p > 0. ? force[1] / p : 1.,
                     s = p > 0. ? force[2] / p : 0.;
        // d(c, s)/d(force_1, force_2)
        const double t11 = p > 0. ? s * s / p : 0., t12 = p > 0. ? -c * s / p : 0.,
                     t22 = p > 0. ? c * c / p : 0.;
        const double radius = closed ? mu * (force[0] - rho * gap[0]) : 0.;
        const double trial = p - rho * (gap[1] * c + gap[2] * s), across = rho * (gap[2] * c - gap[1] * s);
        // (3b) along (c, s): h3 = p - clip(trial, radius); (4b) across it: h4. Residual h3 (c,s) + h4 (-s,c).
        const bool   slips = std::abs(trial) > radius;
        const double sign = trial < 0. ? -1. : 1., h3 = slips ? p - sign * radius : p - trial;
        e.residual[1] = h3 * c - across * s;
        e.residual[2] = h3 * s + across * c;
        // derivatives of h3 and h4
        const Vector3 d_trial = {
            {0., c - rho * (gap[1] * t11 + gap[2] * t12), s - rho * (gap[1] * t12 + gap[2] * t22)}};
        Vector3 h3_f = {{0., c, s}}, h3_g = {{0., 0., 0.}};
        if (slips && closed)
          h3_f[0] = -sign * mu, h3_g[0] = sign * mu * rho;
        if (!slips)
        {
          for (unsigned int j = 1; j < 3; ++j)
            h3_f[j] -= d_trial[j];
          h3_g[1] = rho * c, h3_g[2] = rho * s;
        }
        const Vector3 h4_f = {{0., rho * (gap[2] * t11 - gap[1] * t12), rho * (gap[2] * t12 - gap[1] * t22)}},
                      h4_g = {{0., -rho * s, rho * c}};
        const double dc[3] = {0., t11, t12}, ds[3] = {0., t12, t22};
        for (unsigned int j = 0; j < 3; ++j)
        {
          e.d_force[3 + j] = h3_f[j] * c - h4_f[j] * s + h3 * dc[j] - across * ds[j];
          e.d_force[6 + j] = h3_f[j] * s + h4_f[j] * c + h3 * ds[j] + across * dc[j];
          e.d_gap[3 + j] = h3_g[j] * c - h4_g[j] * s;
          e.d_gap[6 + j] = h3_g[j] * s + h4_g[j] * c;
        }
        return !closed ? PairState::open : (slips ? PairState::slip : PairState::stick);
      }
    };
  } // namespace

  Vector3 JointLaw::solve_acceleration(const Matrix3 &H, const Vector3 &b, const Vector3 &, double,
                                       const bool closed) const
  {
    return solve(H, b, closed);
  }

  std::unique_ptr<JointLaw> make_joint_law(const std::string &name, const double friction,
                                           const std::string &equations)
  {
    if (name == "tied")
      return std::make_unique<Tied>();
    if (name == "FJB")
      return std::make_unique<FJB>();
    if (name == "FJA" && equations == "paper")
      return std::make_unique<FJAPaper>(friction);
    if (name == "FJA")
      return std::make_unique<FJA>(friction);
    throw InputError("There is no joint law \"" + name + "\". The laws are: " + joint_law_names() + ".");
  }

  std::string joint_law_names()
  {
    return "tied|FJA|FJB";
  }
} // namespace Voussoir
