// SPDX-License-Identifier: GPL-3.0-or-later
// Plane waves through a joint against the exact solution, and the energy of elastic runs, through the
// program's own elements and time stepping.
// Usage: exact_waves [impact rule]. A force that is a mean over the step is compared with the exact force in
// its middle.

#include "column.h"

using namespace Columns;

namespace
{
  // h: plane waves through a joint between two half spaces. The ends of the columns are so far away that their
  // reflections do not reach the joint.
  struct Wave
  {
    double ep, eg, etau, eslip, tv, tv_impacts; ///< tv: without the steps in which the joint closes
  };

  using Signal = std::function<Vector3(
      double)>; // incident particle velocity along n, a, b at the distance Lh from the joint

  Wave wave(const Signal &f, const unsigned int ne, const double nu, const ImpactRule rule)
  {
    const double V = .2, Lh = 300., rho = 2400., cp = 3000., cs = 1800., Zp = rho * cp, Zs = rho * cs,
                 p0 = .72e6, mu = .5;
    const double       dt = nu * Lh / ne / cp, duration = Lh / cs + .55, margin = 10. * Lh / ne;
    const unsigned int n_far = std::ceil((.5 * cp * duration + margin) / Lh * ne); // there and back
    const double       far = n_far * Lh / ne;
    Column column = make_column({{-Lh - far, 0., ne + n_far, rho, cp, cs}, {0., far, n_far, rho, cp, cs}});
    Structure         &s = column.structure;
    const unsigned int left = column.node[0].front(), source = column.node[0][n_far],
                       right = column.node[1].back();
    const auto load = [&](const double t, Unknowns &q)
    {
      const Vector3 v = f(t); // half of the force for each direction
      q[3 * left] = p0;
      q[3 * source] = 2. * Zp * V * v[0];
      q[3 * right] = -p0;
      for (unsigned int c = 1; c < 3; ++c)
        q[3 * source + c] = 2. * Zs * V * v[c];
    };
    Unknowns u = column.zero(), load0 = column.zero();
    load(0., load0);
    for (unsigned int b = 0; b < 2; ++b)
      for (unsigned int k = 0; k < column.node[b].size(); ++k)
        u[3 * column.node[b][k]] = -p0 / (rho * cp * cp) * column.x[b][k];
    const JointLaws laws = make_laws(s, "FJA", mu);
    Newmark         newmark(s, laws, tight(), dt, rule);
    newmark.start(u, column.zero(), {p0, 0., 0.}, load0, {0., 0., 0.});
    const History h = run(newmark, dt, std::lround(duration / dt), load, column.zero(), nullptr,
                          rule == ImpactRule::mean_force);

    // The exact solution by quadrature: memory only in the gap and, when it slips, in the slip.
    constexpr unsigned int n_sub = 40;
    const double           step = dt / n_sub;
    const bool             is_mean = rule == ImpactRule::mean_force;
    const auto             q = [&](const double t) { return p0 + Zp * V * f(t - Lh / cp)[0]; };
    double                 gap = 0., s_a = 0., s_b = 0., rate_a = 0., rate_b = 0., p = p0, t_a = 0., t_b = 0.;
    double sum_p = 0., sum_t = 0., ep = 0., etau = 0., eg = 0., eslip = 0., most_gap = 0., most_slip = 0.;
    double tv = 0., tv_impacts = 0., shear_before = 0., tv_exact = 0., t_a_before = 0.;
    double p_then = p0, t_a_then = 0., t_b_then = 0.; // at the time of the force
    bool   open = false;
    for (unsigned int i = 0; i < h.t.size(); ++i)
    {
      for (unsigned int k = 0; i > 0 && k < n_sub; ++k)
      {
        const double t = h.t[i - 1] + k * step, q0 = q(t), q1 = q(t + step);
        if (!open && q1 < 0.)
        {
          const double part = q0 > 0. ? q0 / (q0 - q1) : 0.;
          gap = -q1 / Zp * (1. - part) * step;
          open = true;
        }
        else if (open)
        {
          gap -= (q0 + q1) / Zp * step;
          if (gap <= 0.)
            gap = 0., open = false;
        }
        p = open ? 0. : std::max(q1, 0.);
        const Vector3 v = f(t + step - Lh / cs);
        const double  S_a = Zs * V * v[1], S_b = Zs * V * v[2], S = std::hypot(S_a, S_b);
        const double  part = std::min(1., mu * p / std::max(S, 1e-300));
        t_a = S_a * part, t_b = S_b * part;
        const double new_a = -2. / Zs * (S_a - t_a), new_b = -2. / Zs * (S_b - t_b);
        s_a += .5 * (rate_a + new_a) * step, s_b += .5 * (rate_b + new_b) * step;
        rate_a = new_a, rate_b = new_b;
        if (k + 1 == (is_mean ? n_sub / 2 : n_sub))
          p_then = p, t_a_then = t_a, t_b_then = t_b;
      }
      ep += std::abs(h.force[i][0] - p_then);
      sum_p += p_then;
      eg = std::max(eg, std::abs(h.gap[i][0] - gap));
      most_gap = std::max(most_gap, gap);
      etau += std::hypot(h.force[i][1] - t_a_then, h.force[i][2] - t_b_then);
      sum_t += std::hypot(t_a_then, t_b_then);
      eslip = std::max(eslip, std::hypot(h.gap[i][1] - s_a, h.gap[i][2] - s_b));
      most_slip = std::max(most_slip, std::hypot(s_a, s_b));
      if (i > 0)
        tv_impacts += std::abs(h.force[i][1] - h.force[i - 1][1]);
      // In the step in which the joint closes the mean force holds the impulse of the impact.
      if (!is_mean || i == 0 || h.gap[i - 1][0] < 1e-6 * most_gap || h.force[i][0] <= 0.)
      {
        tv += std::abs(h.force[i][1] - shear_before);
        shear_before = h.force[i][1];
      }
      tv_exact += std::abs(t_a_then - t_a_before);
      t_a_before = t_a_then;
    }
    return {ep / sum_p, eg / most_gap, etau / sum_t, eslip / most_slip, tv / tv_exact, tv_impacts / tv_exact};
  }

  void test_h()
  {
    const double w = 2. * pi * 5.;
    const auto   on = [=](const double t) { return t > 0. && t < 4. * pi / w ? 1. : 0.; };
    const Signal P = [=](const double t) -> Vector3 { return {{-std::sin(w * t) * on(t), 0., 0.}}; };
    const Signal SH = [=](const double t) -> Vector3 { return {{0., std::sin(w * t) * on(t), 0.}}; };
    const Signal S2 = [=](const double t) -> Vector3 {
      return {{0., std::sin(w * t) * on(t), .7 * std::sin(1.5 * w * t) * on(t)}};
    };
    const Signal PS = [=](const double t) -> Vector3
    {
      return {
          {-std::sin(w * t) * on(t), .6 * std::sin(1.3 * w * t) * on(t), .4 * std::sin(.7 * w * t) * on(t)}};
    };
    Wave r = wave(P, 60, 1.5, ImpactRule::mean_force);
    below("h P wave: pressure, L1", r.ep, 3e-2);
    below("h P wave: gap", r.eg, 8e-3);
    r = wave(SH, 60, 1.5, ImpactRule::mean_force);
    below("h SH wave: shear, L1", r.etau, 2.5e-2);
    below("h SH wave: slip", r.eslip, 8e-3);
    r = wave(S2, 60, 1.5, ImpactRule::mean_force);
    note("h two S waves: shear, L1", r.etau);
    note("h two S waves: slip", r.eslip);
    for (const double nu : {.5, .75, 1., 1.25, 1.5, 2., 3.})
    {
      r = wave(PS, 60, nu, ImpactRule::mean_force);
      const std::string what = "h P and S, Courant number " + text(nu);
      below(what + ": slip", r.eslip, nu <= 1.5 ? 8e-3 : (nu == 2. ? 1.6e-2 : 3.5e-2));
      below(what + ": variation of the shear / exact", r.tv, 1.5);
      // at 0.75: the mean force over the two steps of impact
      missed(what + ": the same with the steps of impact", r.tv_impacts, 1.5);
    }
    report_energy("h");
    for (const double nu : {.5, 1.5, 3.})
    {
      r = wave(PS, 60, nu, ImpactRule::paper);
      const std::string what = "h P and S, rule of the paper, Courant number " + text(nu);
      note(what + ": slip", r.eslip);
      note(what + ": variation", r.tv);
    }
    report_energy("h, rule of the paper", ImpactRule::paper);
  }

  /** Energy of elastic runs, and a tied joint against no joint. */
  void test_elastic()
  {
    const Bar one{0., 5., 10, 2400., 3000., 1800.}, two{5., 10., 10, 2400., 3000., 1800.},
        both{0., 10., 20, 2400., 3000., 1800.};
    const double dt = 4e-4;
    Unknowns     monolithic, tied;
    for (const std::string law : {"none", "tied", "FJB"})
      for (const bool damped : {false, true})
      {
        Column             column = law == "none" ? make_column({both}) : make_column({one, two});
        Structure         &s = column.structure;
        const unsigned int left = column.node.front().front(), right = column.node.back().back();
        s.damping.mass = damped ? 5. : 0.;
        s.damping.stiffness = damped ? 1e-4 : 0.;
        if (law == "none")
          s.n_joints = 0;
        const JointLaws laws = make_laws(s, law == "none" ? "tied" : law, 0.);
        Newmark         newmark(s, laws, tight(), dt, ImpactRule::mean_force);
        Unknowns        none(3 * s.pairs.size(), 0.), load;
        newmark.start(column.zero(), column.zero(), none, column.zero(), none);
        double       slip = 0.;
        JointAccount joints(newmark);
        for (unsigned int i = 1; i <= 500; ++i)
        {
          load = column.zero();
          for (unsigned int c = 0; c < 3; ++c)
            load[3 * left + c] = 1e6 * std::sin((300. + 170. * c) * i * dt);
          newmark.advance(load);
          joints.see(newmark);
          if (law != "none")
          {
            const Vector3 gap = newmark.opening_and_slip(0);
            slip = std::max({slip, std::abs(gap[1]), std::abs(gap[2])});
          }
        }
        see_energy(newmark, joints);
        const Energy     &e = newmark.state().energy;
        const std::string what = "elastic, joint " + law + (damped ? ", damped: " : ": ");
        below(what + "energy balance / input", e.balance(newmark.initial_energy()) / e.input, 1e-6);
        below(what + "energy error", newmark.energy_error(), 1e-10);
        if (law != "none")
          below(what + "work at the joint / input",
                (std::abs(e.friction) + (law == "tied" ? std::abs(e.impact) : 0.)) / e.input, 1e-10);
        if (law == "FJB")
          below(what + "slip / displacement", slip / std::abs(newmark.state().u[3 * left + 1]), 1e-9);
        if (law == "none" && damped)
          monolithic = newmark.state().u;
        if (law == "tied" && damped)
          tied = {newmark.state().u[3 * right], newmark.state().u[3 * right + 1],
                  newmark.state().u[3 * right + 2]};
        if (law == "tied" && damped)
        {
          const Column plain = make_column({both});
          double       error = 0., size = 0.;
          for (unsigned int c = 0; c < 3; ++c)
          {
            const double u = monolithic[3 * plain.node[0].back() + c];
            error = std::max(error, std::abs(tied[c] - u));
            size = std::max(size, std::abs(u));
          }
          below("elastic, joint tied: displacement against no joint", error / size, 1e-9);
        }
      }
    report_energy("elastic");
  }
} // namespace

int main()
{
  return run_all({test_h, test_elastic});
}
