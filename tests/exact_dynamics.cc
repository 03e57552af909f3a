// SPDX-License-Identifier: GPL-3.0-or-later
// Impact and sliding against exact solutions, through the program's own elements and time
// stepping: bars on a wall, two bars, blocks that slide, oblique impact.
// Usage: exact_dynamics [explicit]. A force that is a mean over the step is compared with the exact mean.

#include "column.h"

#include <voussoir/dynamics/leapfrog.h>

using namespace Columns;

namespace
{
  constexpr double g = 9.81;

  bool is_explicit = false; ///< the leapfrog rule with half of the step, not Newmark's

  std::unique_ptr<Integrator> scheme(const Structure &structure, const JointLaws &laws, const double dt,
                                     const ImpactRule rule = ImpactRule::mean_force)
  {
    if (is_explicit)
      return std::make_unique<Leapfrog>(structure, laws, dt, 2);
    return std::make_unique<Newmark>(structure, laws, tight(), dt, rule);
  }

  void account(const std::string &what)
  {
    report_energy(what, ImpactRule::mean_force);
  }

  /** The part of the time of a force, t - dt to t or only t, that lies between @p begin and @p end. */
  double part_of(const double t, const double dt, const double begin, const double end, const bool is_mean)
  {
    if (!is_mean)
      return t > begin && t < end;
    return std::max(0., std::min(t, end) - std::max(t - dt, begin)) / dt;
  }

  // a1: elastic bar that hits a rigid wall with 10 m/s
  struct BarOnWall
  {
    double eu = 0., ep = 0., osc = 0., least_dE = 1e300, largest_dE = -1e300, pmax = 0., impulse = 0.;
    int    chatter = 0;
  };

  BarOnWall bar_on_wall(const unsigned int ne, const double nu, const ImpactRule rule)
  {
    const double L = 10., c = 30., v0 = 10., tw = L / c, dt = nu * L / ne / c, p_exact = c * v0;
    Column       column = make_column({bar(0., L, ne, 900., 1.)});
    column.structure.pairs.push_back(wall(column.node[0][0]));
    column.structure.collect_interfaces();
    const JointLaws laws = make_laws(column.structure, "FJA", 0.);
    const auto      integrator = scheme(column.structure, laws, dt, rule);
    const bool      is_mean = rule == ImpactRule::mean_force;
    BarOnWall       result;
    for (const double phi : {.1, .3, .5, .7, .9})
    {
      const double h0 = 5. + phi * v0 * dt, t1 = h0 / v0;
      Unknowns     v = column.zero();
      column.set(v, 0, {{-v0, 0., 0.}});
      integrator->start(column.zero(), v, {0., 0., 0.}, column.zero(), {-h0, 0., 0.});
      double        impulse = 0.;
      const auto    see = [&] { impulse += integrator->impulses()[0]; };
      const History h =
          run(*integrator, dt, std::lround((1. + 2. * tw) / dt), nullptr, column.zero(), see, is_mean);
      double       eu = 0., ep = 0., sum = 0., osc = 0.;
      unsigned int n_core = 0;
      for (unsigned int i = 0; i < h.t.size(); ++i)
      {
        const double s = h.t[i] - t1, p = h.force[i][0], pe = p_exact * part_of(s, dt, 0., 2. * tw, is_mean);
        const double q = s < 0. ? h0 - v0 * h.t[i] : (s < 2. * tw ? 0. : v0 * (s - 2. * tw));
        eu += (h.gap[i][0] - q) * (h.gap[i][0] - q);
        ep += std::abs(p - pe);
        sum += pe;
        result.pmax = std::max(result.pmax, p / p_exact);
        if (s > .2 * tw && s < 1.8 * tw) // both ends of the step in contact
        {
          osc += (p / pe - 1.) * (p / pe - 1.);
          ++n_core;
          result.chatter += p <= 0.;
        }
      }
      const Energy &e = integrator->state().energy;
      const double  dE = (e.kinetic + e.strain) / (.5 * L * v0 * v0) - 1.;
      result.eu += std::sqrt(eu / h.t.size()) / 5. / 5.;
      result.ep += ep / sum / 5.;
      const double change = column.total(0, 0, integrator->state().v) + L * v0;
      result.impulse = std::max(result.impulse, std::abs(impulse / change - 1.));
      result.osc = std::max(result.osc, std::sqrt(osc / n_core));
      result.least_dE = std::min(result.least_dE, dE);
      result.largest_dE = std::max(result.largest_dE, dE);
    }
    return result;
  }

  void test_a()
  {
    for (const bool paper : {false, true})
    {
      const std::string what = paper ? "a1 (rule of the paper) " : "a1 bar on wall: ";
      const ImpactRule  rule = paper ? ImpactRule::paper : ImpactRule::mean_force;
      const BarOnWall   r = bar_on_wall(100, 1.5, rule), fine = bar_on_wall(200, 1.5, rule);
      below(what + "displacement", r.eu, 1e-2);
      below(what + "force, L1", r.ep, 2.6e-2);
      below(what + "force, oscillation", r.osc, 4e-3);
      between(what + "energy change, least", r.least_dE, -1e-2, 0.);
      between(what + "energy change, largest", r.largest_dE, -1e-2, 0.);
      below(what + "largest force / exact", r.pmax, 1.25);
      below(what + "impulse / change of momentum", r.impulse, 1e-10);
      report(what + "steps without contact", r.chatter, "0", r.chatter == 0);
      above(what + "force error, ne=100 / ne=200", r.ep / fine.ep, 1.6);
      report_energy(what, rule);
    }
    above("a1 plain Newmark: largest energy change", bar_on_wall(100, 1.5, ImpactRule::none).largest_dE, .5);
    report_energy("a1 plain Newmark", ImpactRule::none);
  }

  // b: a bar hits another one with 10 m/s
  void two_bars(const std::string &name, const Bar &one, const Bar &two, const double p, const double v1,
                const double v2)
  {
    const double    v0 = 10., L1 = one.to - one.from, L2 = two.to - two.from, c = 30.;
    const double    dt = 1.5 * std::min(L1 / one.n, L2 / two.n) / c, g0 = v0 * 10.37 * dt, t1 = g0 / v0;
    const Column    column = make_column({one, two});
    const JointLaws laws = make_laws(column.structure, "FJA", .5);
    const auto      integrator = scheme(column.structure, laws, dt);
    Unknowns        v = column.zero();
    column.set(v, 0, {{v0, 0., 0.}});
    integrator->start(column.zero(), v, {0., 0., 0.}, column.zero(), {-g0, 0., 0.});
    const double m1 = column.mass(0), m2 = column.mass(1);
    double       momentum = 0., impulse = 0.;
    const auto   see = [&]
    {
      impulse += integrator->impulses()[0];
      const Unknowns &now = integrator->state().v;
      momentum =
          std::max(momentum, std::abs((column.total(0, 0, now) + column.total(1, 0, now)) / (m1 * v0) - 1.));
    };
    const History h =
        run(*integrator, dt, std::lround((t1 + 3. * std::max(L1, L2) / c) / dt), nullptr, column.zero(), see);
    double ep = 0., sum = 0., grazing = 0., range = g0;
    for (unsigned int i = 0; i < h.t.size(); ++i)
    {
      const double s = h.t[i] - t1, pe = p * part_of(s, dt, 0., 2. * L1 / c, true);
      ep += std::abs(h.force[i][0] - pe);
      sum += pe;
      range = std::max(range, v0 * (s - 2. * L2 / c));
      if (s > 2. * L1 / c && s < 2. * L2 / c)
        grazing = std::max(grazing, h.gap[i][0]);
    }
    below(name + ": force, L1", ep / sum, 3e-2);
    below(name + ": final velocity of bar 2", (column.total(1, 0, integrator->state().v) / m2 - v2) / v0,
          1.5e-2);
    note(name + ": final velocity of bar 1 - exact",
         (column.total(0, 0, integrator->state().v) / m1 - v1) / v0);
    below(name + ": momentum", momentum, 1e-9);
    below(name + ": impulse / change of momentum", impulse / column.total(1, 0, integrator->state().v) - 1.,
          1e-10);
    if (L2 > L1)
      below(name + ": gap while grazing", grazing / range, 2e-2);
  }

  void test_b()
  {
    const Bar one = bar(-10., 0., 100, 900., 1.);
    two_bars("b1 equal bars", one, bar(0., 10., 100, 900., 1.), 150., 0., 10.);
    two_bars("b2 grazing", one, bar(0., 20., 200, 900., 1.), 150., 0., 5.);
    two_bars("b3 impedances 1:4", one, bar(0., 10., 100, 3600., 4.), 240., -6., 4.);
    two_bars("b4 meshes 4:1", bar(-10., 0., 50, 900., 1.), bar(0., 10., 200, 900., 1.), 150., 0., 10.);
    account("b");
  }

  // One node of 1 kg at a wall, n = x
  struct Particle
  {
    Column    column = make_column({bar(0., 1., 1, 1e-9, 1.)}, nullptr, true);
    JointLaws laws;
    explicit Particle(const double mu)
    {
      column.structure.pairs.push_back(wall(column.node[0][0]));
      column.structure.collect_interfaces();
      laws = make_laws(column.structure, "FJA", mu);
    }
  };

  void test_c1()
  {
    const double A = .5 * g, T0 = .3, mu = .2, V = A * T0, exact = -V * V / (2. * mu * g) * (1. - mu * g / A);
    const Particle p(mu);
    for (const double step : {.02, .01, .005, .0025})
    {
      const double dt = 1.0137 * step;
      const auto   integrator = scheme(p.column.structure, p.laws, dt);
      integrator->start({0., 0., 0.}, {0., 0., 0.}, {g, mu * g, 0.}, {-g, -A, 0.}, {0., 0., 0.});
      const History h = run(*integrator, dt, std::lround(1.3 / dt),
                            [&](const double t, Unknowns &f) {
                              f = {-g, t < T0 ? -A : 0., 0.};
                            },
                            {0., 0., 0.});
      double        noise = 0.;
      for (unsigned int i = 0; i < h.t.size(); ++i)
        if (h.t[i] > 1.)
          noise = std::max(noise, std::abs(h.force[i][1]) / (mu * g));
      const std::string what = "c1 pulse, dt = " + text(step) + ": ";
      if (step == .005)
        below(what + "slip", h.gap.back()[1] / exact - 1., 2.5e-2);
      else
        note(what + "slip error", h.gap.back()[1] / exact - 1.);
      below(what + "friction in stick / limit", noise, 1e-6);
    }
    account("c1");
  }

  /** A force along the wall turns and reverses the slip. A mass like that of water couples the normal and the tangential
   * motion in half of the runs. */
  void test_reversal()
  {
    double excess = 0.; // of friction over its limit, or tension [N]
    for (const bool has_water : {false, true})
      for (const double w : {7., 19., 41.})
      {
        Particle p(.4);
        if (has_water)
          p.column.structure.mass[p.column.node[0][0]] = {{2., .5, .3, .5, 1.5, .2, .3, .2, 1.}};
        Leapfrog leapfrog(p.column.structure, p.laws, .005, 1);
        leapfrog.start({0., 0., 0.}, {0., 0., 0.}, {g, 0., 0.}, {-g, 0., 0.}, {0., 0., 0.});
        run(
            leapfrog, .005, 800,
            [&](const double t, Unknowns &f) {
              f = {-g, .8 * g * std::sin(w * t), .6 * g * std::sin(1.6 * w * t)};
            },
            {0., 0., 0.},
            [&]
            {
              const Unknowns &f = leapfrog.state().force;
              excess = std::max({excess, length(f[1], f[2]) - .4 * f[0], -f[0]});
            });
      }
    below("reversed slip: excess over the limit of friction, over the weight", excess / g, 1e-12);
    account("reversed slip");
  }

  // c4: shear column on a base that shakes; x upwards, slip along y
  struct Sliding
  {
    std::vector<double> slip, top, friction;
  };

  Sliding sliding_column(const unsigned int refinement)
  {
    constexpr unsigned int ne = 20;
    constexpr double H = 20., cs = 400., rho = 2000., A = .6 * g, w = 2. * pi * 3., mu = .25, dt0 = .0025;
    Column           column = make_column({{0., H, ne, rho, cs * std::sqrt(2.), cs}});
    Structure       &s = column.structure;
    s.pairs.push_back(wall(column.node[0][0]));
    s.collect_interfaces();
    s.damping.stiffness = .04 / (2. * cs * ne / H * std::sin(pi / (4. * ne)));
    const JointLaws laws = make_laws(s, "FJA", mu);
    const double    dt = dt0 / refinement;
    Newmark         newmark(s, laws, tight(), dt, ImpactRule::mean_force);
    Unknowns        u = column.zero(), load0 = column.zero();
    const auto      load = [&](const double t, Unknowns &f)
    {
      for (const unsigned int i : column.node[0])
      {
        f[3 * i] = -s.mass[i][0] * g;
        f[3 * i + 1] = -s.mass[i][4] * A * std::sin(w * t);
      }
    };
    load(0., load0);
    double above_layer = column.mass(0); // settled under its weight
    for (unsigned int k = 1; k <= ne; ++k)
    {
      above_layer -= s.mass[column.node[0][k - 1]][0];
      u[3 * column.node[0][k]] =
          u[3 * column.node[0][k - 1]] - above_layer * g * (H / ne) / (rho * 2. * cs * cs);
    }
    newmark.start(u, column.zero(), {column.mass(0) * g, 0., 0.}, load0, {0., 0., 0.});
    Sliding      result;
    unsigned int count = 0;
    double       sum = 0.; // of the means over the steps of the coarse run's step
    run(newmark, dt, std::lround(4. / dt), load, column.zero(),
        [&]
        {
          sum = count > 0 ? sum + newmark.state().force[1] : newmark.state().force[1];
          if (count++ % refinement == 0)
          {
            result.slip.push_back(newmark.state().u[3 * column.node[0][0] + 1]);
            result.top.push_back(newmark.state().u[3 * column.node[0][ne] + 1]);
            result.friction.push_back((count > 1 ? sum / refinement : sum) / (mu * column.mass(0) * g));
            sum = 0.;
          }
        });
    return result;
  }

  void test_c4()
  {
    const Sliding run = sliding_column(1), fine = sliding_column(32);
    double        rms = 0., error = 0., top = 0.;
    const auto    range = std::minmax_element(run.slip.begin(), run.slip.end());
    for (unsigned int i = 0; i < run.slip.size(); ++i)
    {
      top = std::max(top, std::abs(run.top[i]));
      error = std::max(error, std::abs(run.slip[i] - fine.slip[i]));
      rms += (run.friction[i] - fine.friction[i]) * (run.friction[i] - fine.friction[i]);
    }
    const double ptp = 4.263584994e-2; // event-driven reference
    below("c4 sliding column: peak to peak slip", (*range.second - *range.first) / ptp - 1., 2e-2);
    below("c4 sliding column: final slip", (run.slip.back() + 1.758344576e-2) / ptp, 2e-2);
    below("c4 sliding column: largest displacement of the top", top / 4.856131323e-2 - 1., 2e-2);
    below("c4 sliding column: slip, largest error, against dt/32", error / ptp, 2e-2);
    below("c4 sliding column: friction, rms error, against dt/32", std::sqrt(rms / run.slip.size()), 2e-2);
    note("c4 dt/32: final slip", (fine.slip.back() + 1.758344576e-2) / ptp);
    report_energy("c4");
  }

  void test_d1_d2()
  {
    const double theta = pi / 6., n = g * std::cos(theta), along = g * std::sin(theta), dt = .01;
    for (const double mu : {.7, .4})
    {
      const Particle p(mu);
      const auto     integrator = scheme(p.column.structure, p.laws, dt);
      const Unknowns weight = {-n, 0., -along};
      integrator->start({0., 0., 0.}, {0., 0., 0.}, {n, 0., std::min(along, mu * n)}, weight, {0., 0., 0.});
      const History h = run(*integrator, dt, 100, [&](double, Unknowns &f) { f = weight; }, {0., 0., 0.});
      const double  exact = mu == .4 ? -.75335816 : 0.;
      below("d1 incline, friction " + text(mu) + ": slip", h.gap.back()[2] - exact, mu == .4 ? 1e-8 : 1e-14);
      below("d1 incline, friction " + text(mu) + ": normal", h.gap.back()[0], 1e-14);
    }
    const Particle p(.3);
    const auto     integrator = scheme(p.column.structure, p.laws, dt);
    for (const double vt : {1., .2})
    {
      double tangential = 0., normal = 0., impulses = 0.;
      for (unsigned int k = 0; k < 49; ++k)
      {
        const double gap = dt * (3. + .02 + .02 * k);
        integrator->start({0., 0., 0.}, {-1., .6 * vt, .8 * vt}, {0., 0., 0.}, {0., 0., 0.}, {-gap, 0., 0.});
        Vector3 impulse{};
        run(*integrator, dt, 20, nullptr, {0., 0., 0.},
            [&]
            {
              for (unsigned int c = 0; c < 3; ++c)
                impulse[c] += integrator->impulses()[c];
            });
        const Unknowns &v = integrator->state().v;
        const double    left = vt == 1. ? .7 : 0.;
        tangential = std::max({tangential, std::abs(v[1] - .6 * left), std::abs(v[2] - .8 * left)});
        normal = std::max(normal, std::abs(v[0]));
        impulses = std::max({impulses, std::abs(impulse[0] - 1.), std::abs(impulse[1] + .6 * (vt - left)),
                             std::abs(impulse[2] + .8 * (vt - left))});
      }
      below("d2 oblique impact, vt = " + text(vt) + ": tangential velocity after it", tangential, 1e-12);
      below("d2 oblique impact, vt = " + text(vt) + ": normal velocity after it", normal, 1e-12);
      below("d2 oblique impact, vt = " + text(vt) + ": impulse", impulses, 1e-12);
    }
    account("d1, d2");
  }

  /** Oblique impacts of the particle under loads that change its velocity by up to @p most in the step [of
   * the velocity of impact]: the joint may take energy, but create none. */
  void impact_under_load(const double most)
  {
    const Particle p(.6);
    const double   dt = .01;
    const auto     integrator = scheme(p.column.structure, p.laws, dt);
    double         created = 0.;
    for (double share = .01; share < 1.; share += .07)
      for (double vt = 0.; vt < 2.; vt += .4)
        for (double normal = -most; normal < 1.01 * most; normal += .25 * most)
          for (double tangential = -most; tangential < 1.01 * most; tangential += .25 * most)
          {
            const Unknowns f = {normal / dt, tangential / dt, 0.};
            integrator->start({0., 0., 0.}, {-1., vt, 0.}, {0., 0., 0.}, f, {-share * dt, 0., 0.});
            JointAccount joint(*integrator);
            integrator->advance(f);
            joint.see(*integrator);
            created = std::max(created, joint.total);
          }
    const std::string what = "impact under load, change of velocity " + text(most) + ": created [J of .5 J]";
    below(what, created, 1e-12);
  }

  void test_impact_under_load()
  {
    for (const double most : {.25, .5, 1., 2., 4.})
      impact_under_load(most);
  }

  void pressure_shear(const double vn, const double vt, const double mu, const ImpactRule rule)
  {
    const double       H = 10., rho = 2400., cp = 3000., cs = 1800., Zp = rho * cp, Zs = rho * cs;
    const unsigned int ne = 80;
    const double       dt = 1.5 * H / ne / cp, g0 = vn * dt * 5.37, t1 = g0 / vn;
    const double       p = Zp * vn / 2., tau = std::min(Zs * vt / 2., mu * p);
    const Column       column = make_column({{-H, 0., ne, rho, cp, cs}, {0., H, ne, rho, cp, cs}});
    const JointLaws    laws = make_laws(column.structure, "FJA", mu);
    const auto         integrator = scheme(column.structure, laws, dt, rule);
    Unknowns           v = column.zero();
    column.set(v, 0, {{vn, .6 * vt, .8 * vt}});
    integrator->start(column.zero(), v, {0., 0., 0.}, column.zero(), {-g0, 0., 0.});
    const bool    is_mean = rule == ImpactRule::mean_force;
    const History h =
        run(*integrator, dt, std::lround((t1 + 3.2 * H / cp) / dt), nullptr, column.zero(), nullptr, is_mean);
    double ep = 0., etau = 0., n = 0., excess = 0.;
    for (unsigned int i = 0; i < h.t.size(); ++i)
    {
      const double inside = part_of(h.t[i], dt, t1, t1 + 2. * H / cp, is_mean);
      const double t = .6 * h.force[i][1] + .8 * h.force[i][2];
      ep += std::abs(h.force[i][0] / p - inside);
      etau += std::abs(t / tau - inside);
      n += inside;
      excess = std::max(excess, std::hypot(h.force[i][1], h.force[i][2]) - mu * h.force[i][0] * (1. + 1e-9));
    }
    const double v2 =
        (.6 * column.total(1, 1, integrator->state().v) + .8 * column.total(1, 2, integrator->state().v)) /
        column.mass(1);
    const std::string what = "d3 plates, vt = " + text(vt) +
                             (rule == ImpactRule::none ? ", plain Newmark: "
                              : tau < mu * p           ? ", stick: "
                                                       : ", slip: ");
    if (rule != ImpactRule::none)
    {
      below(what + "transverse velocity", v2 * rho * cp / (2. * tau) - 1., 1.5e-2);
      below(what + "normal velocity", column.total(1, 0, integrator->state().v) / column.mass(1) / vn - 1.,
            1.5e-2);
      note(what + "pressure, L1", ep / n);
      note(what + "shear, L1", etau / n);
      report(what + "excess over Coulomb's limit", excess, "<= 0", excess <= 0.);
    }
    else
      above(what + "transverse velocity", std::abs(v2 * rho * cp / (2. * tau) - 1.), .2);
  }

  void test_d3()
  {
    pressure_shear(.5, .2, .5, ImpactRule::mean_force);
    pressure_shear(.5, .8, .5, ImpactRule::mean_force);
    account("d3");
    if (is_explicit)
      return;
    pressure_shear(.5, .2, .5, ImpactRule::none);
    report_energy("d3 plain Newmark", ImpactRule::none);
  }
} // namespace

int main(const int argc, char **)
{
  is_explicit = argc > 1;
  if (is_explicit)
    return run_all({test_b, test_c1, test_reversal, test_d1_d2, test_d3});
  return run_all({test_a, test_b, test_c1, test_c4, test_d1_d2, test_impact_under_load, test_d3});
}
