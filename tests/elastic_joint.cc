// SPDX-License-Identifier: GPL-3.0-or-later
// Joints with a stiffness and an adhesion. One pair: equations, Jacobian, exact solution, loss of the adhesion. A bar on
// an elastic joint: static state and free vibration. A stiff joint under pressure does not oscillate.

#include "column.h"

#include <voussoir/contact/elastic_law.h>

using namespace Columns;

namespace
{
  constexpr double friction = .7, area = 3., k_n = 2e9, k_t = 1e9, adhesion = 4e5;

  LawParameters parameters(const double normal = k_n, const double tangential = k_t,
                           const double c = adhesion)
  {
    LawParameters p(friction);
    p.normal_stiffness = normal;
    p.tangential_stiffness = tangential;
    p.adhesion = c;
    return p;
  }

  /** One pair: its law and its memory. */
  struct Elastic
  {
    std::unique_ptr<JointLaw> law;
    std::vector<double>       memory;

    explicit Elastic(const LawParameters &p = parameters(), const std::string &name = "FJA")
        : law(make_joint_law(name, p)), memory(law->n_memory(), 0.)
    {
    }

    PairHistory past(const Vector3 &start = {}) const
    {
      PairHistory result(start);
      result.area = area;
      result.is_mean = true;
      result.memory = memory.data();
      return result;
    }
    double residual(const Vector3 &force, const Vector3 &gap, const Vector3 &start = {}) const
    {
      PairEquations e;
      law->evaluate(force, gap, past(start), 1e9, e);
      return norm(e.residual) + norm(law->error(force, gap, past(start), 1e9));
    }
  };

  void one_pair()
  {
    Elastic      pair;
    const double N = 3e6, T = .5 * (adhesion * area + friction * N), tension = adhesion / friction * area,
                 limit = adhesion * area + friction * N;
    below("pressed and sheared below the limit",
          pair.residual({{N, T, 0.}}, {{-N / (k_n * area), -T / (k_t * area), 0.}}), 1e-6);
    above("  no other deformation",
          pair.residual({{N, T, 0.}}, {{-1.1 * N / (k_n * area), -T / (k_t * area), 0.}}), 1e4);
    below("slipping at the limit of friction and adhesion",
          pair.residual({{N, limit, 0.}}, {{-N / (k_n * area), -limit / (k_t * area) - .01, 0.}}), 1e-6);
    below("pulled below the limit",
          pair.residual({{-.9 * tension, 0., 0.}}, {{.9 * tension / (k_n * area), 0., 0.}}), 1e-6);
    const Vector3 torn = {{-tension, 0., 0.}}, open = {{.01, 0., 0.}};
    below("open at the limit of tension", pair.residual(torn, open), 1e-6);
    report("  loses the adhesion", pair.law->utilisation(torn, open, pair.past()), "2",
           pair.law->utilisation(torn, open, pair.past()) == 2.);
    pair.law->apply_event(pair.memory.data());
    below("then it is free", pair.residual({}, open), 1e-300);
    below(
        "  and has friction alone",
        pair.residual({{N, friction * N, 0.}}, {{-N / (k_n * area), -friction * N / (k_t * area) - .01, 0.}}),
        1e-6);
    Elastic slipped;
    slipped.law->commit({{N, limit, 0.}}, {{0., -.01, 0.}}, slipped.past(), slipped.memory.data());
    below("after a slip the elastic slip is remembered: unloading by the stiffness",
          slipped.residual({{N, limit - 1e5, 0.}}, {{-N / (k_n * area), -.01 + 1e5 / (k_t * area), 0.}},
                           {{0., -.01, 0.}}),
          1e-6);
    below("  stored energy",
          slipped.law->elastic_law()->stored_energy(area, slipped.memory.data()) /
                  (.5 * N * N / (k_n * area) + .5 * limit * limit / (k_t * area)) -
              1.,
          1e-14);
  }

  std::vector<Elastic> states()
  {
    std::vector<Elastic> list;
    for (const auto &p :
         {parameters(), parameters(k_n, 0., 0.), parameters(0., k_t, adhesion), parameters(0., 0., adhesion)})
    {
      list.emplace_back(p);
      list.emplace_back(p);
      list.back().memory = {p.adhesion > 0. ? 1. : 0., 1e5, 6e4, -4e4};
    }
    list.emplace_back(parameters(k_n, k_t, 0.), "FJB");
    LawParameters bond = parameters(k_n, k_t, 0.);
    bond.strength = 1e6, bond.fracture_energy = 100.;
    list.emplace_back(bond, "cohesive");
    return list;
  }

  void jacobian_and_solution()
  {
    const double size = 3e6, move = size / (k_t * area);
    double       worst = 0., wrong = 0.;
    for (const Elastic &pair : states())
      for (unsigned int sample = 0; sample < 1000; ++sample)
      {
        Vector3 force, gap, b;
        for (unsigned int c = 0; c < 3; ++c)
        {
          force[c] = size * random_number();
          gap[c] = move * random_number();
          b[c] = 2. * move * random_number();
        }
        const PairHistory past = pair.past({{-.1 * move, .1 * move, 0.}});
        constexpr double  rho = 1e10, h = 1e-7;
        PairEquations     e, low, high;
        pair.law->evaluate(force, gap, past, rho, e);
        for (unsigned int k = 0; k < 6; ++k)
        {
          Vector3      f = force, g = gap;
          double      &x = k < 3 ? f[k] : g[k - 3];
          const double scale = k < 3 ? size : move, x0 = x;
          x = x0 - h * scale;
          pair.law->evaluate(f, g, past, rho, low);
          x = x0 + h * scale;
          pair.law->evaluate(f, g, past, rho, high);
          if (low.state != high.state)
            continue; // a kink
          for (unsigned int i = 0; i < 3; ++i)
          {
            const double d = (high.residual[i] - low.residual[i]) / (2. * h),
                         exact = scale * (k < 3 ? e.d_force[3 * i + k] : e.d_gap[3 * i + k - 3]);
            worst = std::max(worst, std::abs(d - exact) / (size + rho * move));
          }
        }
        const double  flexible = .5 / (k_t * area);
        const Matrix3 H = {{flexible, .2 * flexible, .1 * flexible, .2 * flexible, flexible, 0.,
                            .1 * flexible, 0., .8 * flexible}};
        const Vector3 solution = pair.law->solve(H, b, past);
        Vector3       of_solution = H * solution;
        add(of_solution, b);
        wrong = std::max(wrong, norm(pair.law->error(solution, of_solution, past, 1. / flexible)) / size);
      }
    below("Jacobian - differences of the equations, over their size", worst, 1e-6);
    below("exact solution of a pair: error / force", wrong, 1e-10);
  }

  /** A bar of 1 m2 on an elastic joint at a wall. */
  struct BarOnJoint
  {
    BarOnJoint(const double normal, const double tangential, const bool rigid)
        : column(make_column({bar(0., 10., 10, 2e10, 2400.)}, nullptr, rigid))
    {
      column.structure.pairs.push_back(wall(column.node[0][0]));
      column.structure.collect_interfaces();
      LawParameters p = parameters(normal, tangential, 0.);
      laws.of_joint.push_back(make_joint_law("FJA", p));
      laws.assign(column.structure);
    }
    Column    column;
    JointLaws laws;
  };

  void compressed_bar()
  {
    const BarOnJoint bars(k_n, 0., false);
    StepOperator     operation;
    operation.proximal = 1e-4; // the rigid-body motion across the bar
    JointSystem  system(bars.column.structure, bars.laws, tight(), operation);
    Unknowns     load = bars.column.zero(), force(3, 0.), gap, u;
    const double F = 4e6;
    load[3 * bars.column.node[0].back()] = -F;
    const ContactResult result = system.solve(load, {0., 0., 0.}, {0., 0., 0.}, force, gap, u);
    report("bar on an elastic joint converges", result.iterations, "few", result.converged);
    below("  gap - force / stiffness", gap[0] / (-force[0] / k_n) - 1., 1e-6);
    below("  shortening of bar and joint",
          u[3 * bars.column.node[0].back()] / (-F * (1. / k_n + 10. / 2e10)) - 1., 1e-6);
  }

  /** Free vibration of a rigid mass that is pressed on its joint: frequency, decay by the backward Euler rule of the
   * joint, energy balance. */
  void vibration()
  {
    const BarOnJoint bars(k_n, 0., true);
    const double     m = bars.column.mass(0), omega = std::sqrt(k_n / m), period = 2. * pi / omega,
                 F = 2. * m * 9.81;
    for (const double steps : {100., 400.})
    {
      const double dt = period / steps;
      Newmark      newmark(bars.column.structure, bars.laws, tight(), dt, ImpactRule::mean_force);
      Unknowns     load = {-F, 0., 0.}, memory = bars.laws.initial_memory();
      const double rest = -F / k_n, amplitude = .5 * F / k_n;
      memory[1] = F - k_n * amplitude; // the stress of the start
      newmark.start({rest + amplitude, 0., 0.}, {0., 0., 0.}, {F - k_n * amplitude, 0., 0.}, load,
                    {0., 0., 0.}, memory);
      JointAccount account(newmark);
      double       last = 1., crossing = 0., largest = 0.;
      for (unsigned int i = 1; i <= 2 * steps; ++i)
      {
        newmark.advance(load, {});
        account.see(newmark);
        const double x = (newmark.state().u[0] - rest) / amplitude;
        if (x < 0. && last >= 0. && crossing == 0.)
          crossing = (i - 1. + last / (last - x)) / steps; // in periods
        largest = i > 1.5 * steps ? std::max(largest, x) : largest;
        last = x;
      }
      note("mass on an elastic joint, " + text(steps) + " steps per period: amplitude after two periods",
           largest);
      below("  quarter period", crossing / .25 - 1., 4. / steps);
      below("  loss of amplitude times steps", (1. - largest) * steps, 30.);
      below("  energy balance / largest", newmark.energy_error(), 1e-12);
      below("  energy made in a step / largest", account.total / newmark.largest_energy(), 1e-13);
    }
  }

  /** A very stiff joint under a growing load: force and velocity follow the load without oscillation. */
  void pressed()
  {
    const BarOnJoint bars(1e13, 1e13, true);
    const double     m = bars.column.mass(0), dt = .01;
    Newmark          newmark(bars.column.structure, bars.laws, tight(), dt, ImpactRule::mean_force);
    newmark.start({0., 0., 0.}, {-.1, 0., 0.}, {0., 0., 0.}, {0., 0., 0.}, {0., 0., 0.});
    double worst = 0., fastest = 0.;
    for (unsigned int i = 1; i <= 50; ++i)
    {
      const double F = m * 9.81 * i / 50.;
      newmark.advance({-F, .2 * F, 0.}, {});
      if (i > 5)
      {
        worst = std::max(worst, std::abs(newmark.state().force[0] / (m * 9.81 * (i - .5) / 50.) - 1.));
        fastest = std::max(fastest, std::abs(newmark.state().v[0]));
      }
    }
    below("stiff joint: mean force - mean load", worst, 1e-3);
    below("  velocity after the impact [m/s]", fastest, 1e-6);
  }
} // namespace

int main()
{
  return run_all({one_pair, jacobian_and_solution, compressed_bar, vibration, pressed});
}
