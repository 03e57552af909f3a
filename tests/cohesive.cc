// SPDX-License-Identifier: GPL-3.0-or-later
// Law cohesive: one pair along its softening, its Jacobian, its exact solution; a block that is torn off;
// what it does in the limits of no strength and of any strength.

#include "column.h"

using namespace Columns;

namespace
{
  constexpr double strength = 2e6, fracture_energy = 150., friction = .7, area = 3.;
  constexpr double end = 2. * fracture_energy / strength; // opening at which the bond is lost

  LawParameters parameters(const double f_t = strength, const double G_f = fracture_energy)
  {
    LawParameters p(friction);
    p.strength = f_t;
    p.fracture_energy = G_f;
    return p;
  }

  /** One pair: its law and its memory. */
  struct Bond
  {
    std::unique_ptr<JointLaw> law;
    double                    memory[2] = {0., 0.};

    explicit Bond(const LawParameters &p = parameters()) : law(make_joint_law("cohesive", p)) {}

    PairHistory past(const Vector3 &start, const bool is_mean = false) const
    {
      PairHistory result(start);
      result.area = area;
      result.is_mean = is_mean;
      result.memory = memory;
      return result;
    }
    double residual(const Vector3 &force, const Vector3 &gap, const PairHistory &past) const
    {
      PairEquations e;
      law->evaluate(force, gap, past, 1e9, e);
      return norm(e.residual) + norm(law->error(force, gap, past, 1e9));
    }
    /** Opens to @p w under the tension @p stress, which the law must allow, and accepts it. */
    void open(const std::string &what, const double from, const double w, const double stress)
    {
      const Vector3     force = {{-stress * area, 0., 0.}}, gap = {{w, 0., 0.}};
      const PairHistory before = past({{from, 0., 0.}});
      below(what, residual(force, gap, before) / (strength * area), 1e-12);
      above("  and no other stress", residual({{-1.01 * stress * area - 1., 0., 0.}}, gap, before), .5);
      law->commit(force, gap, before, memory);
    }
  };

  void softening()
  {
    Bond              bond;
    const Vector3     pull = {{-.999 * strength * area, 5e6, -7e6}};
    const PairHistory at_rest = bond.past({});
    below("bonded: tied below its strength, whatever the shear", bond.residual(pull, {}, at_rest), 1e-300);
    above("  so it is against any movement", bond.residual(pull, {{0., 1e-6, 0.}}, at_rest), 100.);
    above("  no event: 1 - excess", 1. - bond.law->utilisation(pull, {}, at_rest), 5e-4);
    const Vector3 tear = {{-1.001 * strength * area, 0., 0.}};
    above("beyond it is to crack: excess - 1", bond.law->utilisation(tear, {}, at_rest) - 1., 5e-4);
    bond.law->apply_event(bond.memory);
    report("  once", bond.law->utilisation(tear, {}, at_rest), "0",
           bond.law->utilisation(tear, {}, at_rest) == 0.);
    bond.open("stress at a third of the last opening", 0., end / 3., strength * 2. / 3.);
    below("  energy: held and lost, over the law's integral",
          bond.law->bond_energy({{end / 3., 0., 0.}}, area, bond.memory) /
                  (fracture_energy * area * 5. / 9.) -
              1.,
          1e-14);
    bond.open("back half the way: straight to the origin", end / 3., end / 6., strength / 3.);
    below("  energy",
          bond.law->bond_energy({{end / 6., 0., 0.}}, area, bond.memory) /
                  (fracture_energy * area * 7. / 18.) -
              1.,
          1e-14);
    const Vector3 press = {{4e5, .9 * friction * 4e5, 0.}}, slip = {{4e5, friction * 4e5, 0.}};
    const auto    closed = bond.past({{end / 6., 0., 0.}});
    below("closed again: friction holds", bond.residual(press, {}, closed), 1e-300);
    below("  and slips", bond.residual(slip, {{0., -1e-3, 0.}}, closed), 1e-6);
    bond.open("again to where it was", end / 6., end / 3., strength * 2. / 3.);
    bond.open("and on", end / 3., .9 * end, .1 * strength);
    const Vector3 far = {{2. * end, 0., 0.}};
    bond.law->commit({}, far, bond.past({}), bond.memory);
    below("lost: energy / (G_f area) - 1",
          bond.law->bond_energy(far, area, bond.memory) / (fracture_energy * area) - 1., 1e-14);
    below("  free when open", bond.residual({}, far, bond.past(far)), 1e-300);
  }

  /** Cracked, but not open at the end of the step: bonded again, unless it slid. */
  void not_opened()
  {
    for (const bool slid : {false, true})
    {
      Bond bond;
      bond.law->apply_event(bond.memory);
      const PairHistory at_rest = bond.past({});
      bond.law->commit({{-.5 * strength * area, 0., 0.}}, {{0., slid ? .1 * end : 0., 0.}}, at_rest,
                       bond.memory);
      const double shear = bond.residual({{0., 1e6, 0.}}, {}, at_rest);
      if (slid)
        above("cracked, slid and closed: it has friction only", shear, 1e3);
      else
        below("cracked and relieved before it moved: bonded again", shear, 1e-300);
      if (slid)
      {
        PairEquations e;
        bond.law->evaluate({{1e6, 0., 0.}}, {}, at_rest, 1e9, e);
        report("  its next impulses are those of friction", e.active, "1", e.active == 1);
      }
    }
  }

  /** States of a bond with points on both sides of each of its branches. */
  std::vector<Bond> states()
  {
    std::vector<Bond> list(4);
    for (unsigned int i = 1; i < 4; ++i)
    {
      list[i].memory[0] = i < 3 ? 1. : 2.;
      list[i].memory[1] = i == 1 ? 0. : i == 2 ? .4 * end : end;
    }
    return list;
  }

  void jacobian()
  {
    double worst = 0.;
    for (const Bond &bond : states())
      for (const bool is_mean : {false, true})
        for (unsigned int sample = 0; sample < 500; ++sample)
        {
          Vector3 force, gap;
          for (unsigned int c = 0; c < 3; ++c)
          {
            force[c] = 2. * strength * area * random_number();
            gap[c] = end * random_number();
          }
          const PairHistory past = bond.past({{.3 * end * std::abs(random_number()), .1 * end, 0.}}, is_mean);
          constexpr double  rho = 1e11, h = 1e-7;
          PairEquations     e, low, high;
          bond.law->evaluate(force, gap, past, rho, e);
          for (unsigned int k = 0; k < 6; ++k)
          {
            Vector3      f = force, g = gap;
            double      &x = k < 3 ? f[k] : g[k - 3];
            const double size = k < 3 ? strength * area : end, x0 = x;
            x = x0 - h * size;
            bond.law->evaluate(f, g, past, rho, low);
            x = x0 + h * size;
            bond.law->evaluate(f, g, past, rho, high);
            if (low.state != high.state)
              continue; // a kink
            for (unsigned int i = 0; i < 3; ++i)
            {
              const double d = (high.residual[i] - low.residual[i]) / (2. * h),
                           exact = size * (k < 3 ? e.d_force[3 * i + k] : e.d_gap[3 * i + k - 3]);
              worst = std::max(worst, std::abs(d - exact) / (strength * area + rho * end));
            }
          }
        }
    below("Jacobian - differences of the equations, over their size", worst, 1e-6);
  }

  void exact_solution()
  {
    double worst = 0.;
    for (const Bond &bond : states())
      for (const bool is_mean : {false, true})
        for (unsigned int sample = 0; sample < 500; ++sample)
        {
          const double h = .3 * end / (strength * area); // softer than the softening would jump
          Matrix3      H = {{h, .2 * h, .1 * h, .2 * h, h, 0., .1 * h, 0., .8 * h}};
          Vector3      b;
          for (double &x : b)
            x = 1.5 * end * random_number();
          const PairHistory past = bond.past({{.2 * end, 0., 0.}}, is_mean);
          const Vector3     force = bond.law->solve(H, b, past);
          Vector3           gap = H * force;
          add(gap, b);
          worst = std::max(worst, norm(bond.law->error(force, gap, past, 1. / h)) / (strength * area));
        }
    below("exact solution of a pair: error / strength", worst, 1e-10);
  }

  void limits()
  {
    const auto FJA = make_joint_law("FJA", parameters()), tied = make_joint_law("tied", parameters());
    const Bond none(parameters(0., 0.)), any(parameters(1e300, 0.));
    double     weak = 0., strong = 0.;
    for (unsigned int sample = 0; sample < 1000; ++sample)
    {
      Vector3 force, gap, start;
      for (unsigned int c = 0; c < 3; ++c)
      {
        force[c] = 1e6 * random_number();
        gap[c] = 1e-3 * random_number();
        start[c] = 1e-3 * random_number();
      }
      PairEquations e, f;
      const auto    difference = [&]
      {
        double sum = norm(e.residual - f.residual);
        for (unsigned int k = 0; k < 9; ++k)
          sum += std::abs(e.d_force[k] - f.d_force[k]) + std::abs(e.d_gap[k] - f.d_gap[k]);
        return sum;
      };
      FJA->evaluate(force, gap, start, 1e9, e);
      none.law->evaluate(force, gap, none.past(start), 1e9, f);
      weak += difference();
      tied->evaluate(force, gap, start, 1e9, e);
      any.law->evaluate(force, gap, any.past(start), 1e9, f);
      strong += difference();
    }
    report("no strength: FJA to the last digit", weak, "0", weak == 0.);
    report("any strength: tied to the last digit", strong, "0", strong == 0.);
  }

  /** Of the block at t = 1.5 s. With s = t - 0.5 s since it cracked, its mass f_t times 1 s^2/m and k^2 =
   * 1/w_c: w'' = 2 s + k^2 w until w = w_c, w'' = 1 + 2 s from then on. */
  double exact_velocity(const double f_t, const double G_f)
  {
    const double w_c = 2. * G_f / f_t;
    if (w_c == 0.)
      return 2.;
    const double k = 1. / std::sqrt(w_c);
    double       low = 0., high = 1.;
    for (unsigned int i = 0; i < 60; ++i)
    {
      const double s = .5 * (low + high);
      (2. / (k * k) * (std::sinh(k * s) / k - s) < w_c ? low : high) = s;
    }
    const double s = low, v = 2. / (k * k) * (std::cosh(k * s) - 1.);
    return v + (1. - s) + (1. - s * s);
  }

  /** A block of 1000 kg on a wall, drawn off by a force that grows: bonded until the strength is reached,
   * free afterwards. What the bond took is the fracture energy. */
  void torn_off(const double G_f, const double dt)
  {
    constexpr double f_t = 1e3; // on 1 m^2
    Column           column = make_column({bar(0., 1., 1, 1e-9, 1000.)}, nullptr, true);
    column.structure.pairs.push_back(wall(column.node[0][0]));
    column.structure.collect_interfaces();
    JointLaws laws;
    laws.of_joint.push_back(make_joint_law("cohesive", parameters(f_t, G_f)));
    laws.assign(column.structure);
    Newmark newmark(column.structure, laws, tight(), dt, ImpactRule::mean_force);
    newmark.start(column.zero(), column.zero(), {0., 0., 0.}, column.zero(), {0., 0., 0.});
    double     held = 0.;
    const auto load = [&](const double t, Unknowns &f) { f[0] = 2. * f_t * t; };
    const auto see = [&]
    {
      const DynamicState &s = newmark.state();
      if (s.u[0] <= 1e-12)
        held = s.time;
    };
    run(newmark, dt, std::lround(1.5 / dt), load, column.zero(), see);
    const std::string what = "block torn off, G_f " + text(G_f) + ", dt " + text(dt);
    between(what + ": held until [s]", held, .5 - dt, .5 + dt);
    const Energy &e = newmark.state().energy;
    below("  energy that the bond took - G_f", e.joint_fracture - G_f, 1e-12 * f_t);
    // The round-off of the inertia force is that of 4/dt^2 m u.
    below("  energy account / kinetic", e.balance(newmark.initial_energy()) / e.kinetic, 1e-16 / (dt * dt));
    below("  velocity / exact - 1", newmark.state().v[0] / exact_velocity(f_t, G_f) - 1., 20. * dt * dt);
  }

  /** Softening by f_t^2/(4 G_f) on the mean over a step, with the flexibility dt^2/(2 m) of the block: below G_f =
   * f_t^2 dt^2/(8 m) the step has several solutions, and the bond is lost at once. */
  void brittle()
  {
    constexpr double f_t = 1e3, dt = .01;
    for (const double share : {.99, 1.01})
    {
      Column column = make_column({bar(0., 1., 1, 1e-9, 1000.)}, nullptr, true);
      column.structure.pairs.push_back(wall(column.node[0][0]));
      column.structure.collect_interfaces();
      const double G_f = share * f_t * f_t * dt * dt / (8. * column.structure.mass[column.node[0][0]][0]);
      JointLaws    laws;
      laws.of_joint.push_back(make_joint_law("cohesive", parameters(f_t, G_f)));
      laws.assign(column.structure);
      Newmark newmark(column.structure, laws, tight(), dt, ImpactRule::mean_force);
      newmark.start(column.zero(), column.zero(), {0., 0., 0.}, column.zero(), {0., 0., 0.});
      run(
          newmark, dt, 80, [&](const double t, Unknowns &f) { f[0] = 2. * f_t * t; }, column.zero(), [] {});
      const std::string what = text(share) + " of the smallest G_f of the step: energy of the bond / G_f";
      const double      taken = newmark.state().energy.joint_fracture / G_f;
      between(what, taken, share < 1. ? 0. : 1. - 1e-9, share < 1. ? 0. : 1. + 1e-9);
    }
  }

  /** The block is drawn off until its bond has cracked a little, and pressed back: when it is closed again
   * the bond holds nothing, and has lost what belongs to its largest opening. */
  void closed_again()
  {
    constexpr double f_t = 1e3, G_f = 20., dt = .001;
    Column           column = make_column({bar(0., 1., 1, 1e-9, 1000.)}, nullptr, true);
    column.structure.pairs.push_back(wall(column.node[0][0]));
    column.structure.collect_interfaces();
    JointLaws laws;
    laws.of_joint.push_back(make_joint_law("cohesive", parameters(f_t, G_f)));
    laws.assign(column.structure);
    Newmark newmark(column.structure, laws, tight(), dt, ImpactRule::mean_force);
    newmark.start(column.zero(), column.zero(), {0., 0., 0.}, column.zero(), {0., 0., 0.});
    double     largest = 0.;
    const auto load = [&](const double t, Unknowns &f) { f[0] = t < .6 ? 2. * f_t * t : -2. * f_t; };
    run(newmark, dt, 1500, load, column.zero(),
        [&] { largest = std::max(largest, newmark.opening_and_slip(0)[0]); });
    above("bond closed again: largest opening / w_c", largest / (2. * G_f / f_t), 1e-3);
    below("  opening", newmark.opening_and_slip(0)[0], 1e-12);
    below("  energy of the bond / f_t w_max/2 - 1",
          newmark.state().energy.joint_fracture / (.5 * f_t * largest) - 1., 1e-9);
  }

  /** Two blocks of 1000 kg in series on a wall, pushed sideways, drawn off by a force at the outer one that
   * rises above the strength of both pairs. The weaker bond breaks first and relieves the other one, which
   * must stay as it was: nothing is kicked, nothing creates energy. */
  void relieved(const double G_f, const double weaker)
  {
    constexpr double f_t = 1e3, dt = .001;
    Column           column = make_column({bar(0., 1., 1, 1e8, 1000.), bar(1., 2., 1, 1e8, 1000.)});
    Pair             foot = wall(column.node[0][0]);
    foot.joint = 1;
    column.structure.pairs.push_back(foot);
    column.structure.n_joints = 2;
    column.structure.collect_interfaces();
    JointLaws laws;
    laws.of_joint.push_back(make_joint_law("cohesive", parameters(weaker * f_t, G_f)));
    laws.of_joint.push_back(make_joint_law("cohesive", parameters(f_t, G_f)));
    laws.assign(column.structure);
    const std::size_t n = 3 * column.structure.pairs.size();
    Newmark           newmark(column.structure, laws, tight(), dt, ImpactRule::mean_force);
    newmark.start(column.zero(), column.zero(), Unknowns(n, 0.), column.zero(), Unknowns(n, 0.));
    const unsigned int outer = column.node[1][1], inner = column.node[0][1];
    double             created = 0., moved = 0., before = 0.;
    for (unsigned int i = 1; i <= 200; ++i)
    {
      Unknowns f = column.zero();
      f[3 * outer] = 3. * f_t * std::min(1., i * dt / .005);
      f[3 * outer + 1] = 20.;
      f[3 * inner + 1] = 20.;
      newmark.advance(f);
      const DynamicState &s = newmark.state();
      created = std::max(created, before - s.energy.friction - s.energy.impact);
      before = s.energy.friction + s.energy.impact;
      moved = std::max(moved, norm(newmark.opening_and_slip(1)));
    }
    const std::string   what = "weaker of two bonds torn, G_f " + text(G_f) + ", strength " + text(weaker);
    const DynamicState &s = newmark.state();
    above(what + ": it is open", newmark.opening_and_slip(0)[0], 1e-3);
    if (weaker < .9) // else both crack at once, and the other one may open a little
      below("  the other one has not moved", moved, 1e-9);
    else
      below("  the other one has closed again", newmark.opening_and_slip(1)[0], 1e-6);
    below("  energy created in a step / kinetic", created / s.energy.kinetic, 1e-10);
    below("  energy account / kinetic", s.energy.balance(newmark.initial_energy()) / s.energy.kinetic, 1e-10);
  }
} // namespace

int main()
{
  return run_all({softening, not_opened, jacobian, exact_solution, limits, [] { torn_off(0., .01); },
                  [] { torn_off(0., .001); }, [] { torn_off(5., .001); }, [] { torn_off(20., .0005); },
                  brittle, closed_again, [] { relieved(0., .5); }, [] { relieved(5., .5); },
                  [] { relieved(0., .8); }, [] { relieved(5., .95); }});
}
