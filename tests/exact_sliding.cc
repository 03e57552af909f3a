// SPDX-License-Identifier: GPL-3.0-or-later
// Sliding along a curve against an exact solution: a rotating force drives a block around a circle.
//
// On the circle r (cos wt, sin wt) = r e_r a block of mass m has the acceleration -w^2 r e_r. The direction of
// its slip is e_t = (-sin wt, cos wt), and the friction is -mu N e_t with any normal force N(t) > 0. The
// tangential force that keeps the block on the circle is therefore
//     F = -m w^2 r e_r + mu N e_t.
// For constant N this force has a constant size and rotates. Friction damps other velocities, so neighbouring
// paths approach each other. The work of friction is mu r w times the integral of N.

#include "column.h"

#include <voussoir/base/error.h>

using namespace Columns;

namespace
{
  /** Returns a node of 1 kg with one contact pair, at a wall with the normal x. */
  Column block_at_wall()
  {
    Column column = make_column({bar(0., 1., 1, 1e-9, 1.)}, nullptr, true);
    column.structure.pairs.push_back(wall(column.node[0][0]));
    column.structure.collect_interfaces();
    return column;
  }

  constexpr double mu = .5, w = 2. * pi * 2., duration = 1.; // two turns

  struct Circle
  {
    double r = .05;    ///< [m]
    double g = 9.81;   ///< mean normal force on 1 kg [N]
    double pulse = 0.; ///< of the normal force: N = g (1 + pulse sin 3wt)

    double   normal(const double t) const { return g * (1. + pulse * std::sin(3. * w * t)); }
    Unknowns load(const double t) const
    {
      const double c = std::cos(w * t), s = std::sin(w * t), radial = -w * w * r, along = mu * normal(t);
      return {-normal(t), radial * c - along * s, radial * s + along * c};
    }
  };

  struct Errors
  {
    double path = 0.;     ///< largest distance from the exact place / radius
    double velocity = 0.; ///< the same of the velocity / speed
    double work = 0.;     ///< of friction, relative
  };

  Errors slide(const Circle &circle, const double dt, const ImpactRule rule)
  {
    const Column    column = block_at_wall();
    const JointLaws laws = make_laws(column.structure, "FJA", mu);
    Newmark         newmark(column.structure, laws, tight(), dt, rule);
    const double    r = circle.r, speed = w * r;
    newmark.start({0., r, 0.}, {0., 0., speed}, {circle.g, 0., -mu * circle.g}, circle.load(0.),
                  {0., 0., 0.});
    Errors     errors;
    const auto see = [&]
    {
      const double    t = newmark.state().time, c = std::cos(w * t), s = std::sin(w * t);
      const Unknowns &u = newmark.state().u, &v = newmark.state().v;
      errors.path = std::max(errors.path, std::hypot(u[1] - r * c, u[2] - r * s) / r);
      errors.velocity = std::max(errors.velocity, std::hypot(v[1] + speed * s, v[2] - speed * c) / speed);
    };
    const unsigned int n = std::lround(duration / dt);
    run(
        newmark, dt, n, [&](const double t, Unknowns &f) { f = circle.load(t); }, {0., 0., 0.}, see,
        rule == ImpactRule::mean_force);
    errors.work = newmark.state().energy.friction / (mu * circle.g * speed * n * dt) - 1.;
    return errors;
  }

  /** Steps from 20 ms to 1.25 ms: second order, and small at the last one. */
  void second_order(const std::string &name, const Circle &circle, const double path, const double velocity,
                    const double work)
  {
    Errors coarse = slide(circle, .02, ImpactRule::mean_force);
    note(name + ", dt = 20 ms: path", coarse.path);
    for (const double dt : {.01, .005, .0025, .00125})
    {
      const Errors      fine = slide(circle, dt, ImpactRule::mean_force);
      const std::string what = name + ", dt = " + text(1e3 * dt) + " ms: ";
      note(what + "path", fine.path);
      between(what + "path, 2 dt / dt", coarse.path / fine.path, 3.8, 4.2);
      if (dt < .01)
      {
        between(what + "velocity, 2 dt / dt", coarse.velocity / fine.velocity, 3.8, 4.2);
        between(what + "work of friction, 2 dt / dt", coarse.work / fine.work, 3.8, 4.2);
      }
      coarse = fine;
    }
    below(name + ", dt = 1.25 ms: path", coarse.path, path);
    below(name + ", dt = 1.25 ms: velocity", coarse.velocity, velocity);
    below(name + ", dt = 1.25 ms: work of friction", coarse.work, work);
    report_energy(name);
  }

  void test_circle()
  {
    second_order("circle", {}, 2e-4, 6e-5, 7e-5);
  }

  void test_changing_pressure()
  {
    second_order("circle, changing pressure", {.05, 9.81, .6}, 2.2e-4, 7e-5, 7e-5);
  }

  /** Nothing may hang on a speed in m/s: the same circle a million times smaller. */
  void test_small_circle()
  {
    const Errors large = slide({}, .005, ImpactRule::mean_force),
                 small = slide({.05e-6, 9.81e-6, 0.}, .005, ImpactRule::mean_force);
    below("circle, 50 nm against 50 mm: difference of the path", small.path - large.path, 1e-9);
    below("circle, 50 nm against 50 mm: difference of the velocity", small.velocity - large.velocity, 1e-9);
    report_energy("circle of 50 nm");
  }

  /** Coulomb's law with the friction .8, and .2 once the pair has slid under compression. */
  class Wearing : public JointLaw
  {
  public:
    static constexpr double fresh = .8, worn = .2;

    void evaluate(const Vector3 &force, const Vector3 &gap, const PairHistory &past, const double rho,
                  PairEquations &e) const override
    {
      law(past).evaluate(force, gap, past, rho, e);
    }
    Vector3 error(const Vector3 &force, const Vector3 &gap, const PairHistory &past,
                  const double rho) const override
    {
      return law(past).error(force, gap, past, rho);
    }
    Vector3 solve(const Matrix3 &H, const Vector3 &b, const PairHistory &past) const override
    {
      return law(past).solve(H, b, past);
    }
    Vector3 solve_impulse(const Matrix3 &H, const Vector3 &v, const PairHistory &past,
                          const unsigned char active) const override
    {
      return law(past).solve_impulse(H, v, past, active);
    }
    unsigned int n_memory() const override { return 1; }
    void         commit(const Vector3 &force, const Vector3 &gap, const PairHistory &past,
                        double *memory) const override
    {
      if (force[0] > 0. && std::hypot(gap[1] - past.start[1], gap[2] - past.start[2]) > 1e-6)
        memory[0] = 1.;
    }

  private:
    const JointLaw &law(const PairHistory &past) const
    {
      return past.memory[0] == 0. ? *faces[0] : *faces[1];
    }

    const std::unique_ptr<JointLaw> faces[2] = {make_joint_law("FJA", fresh), make_joint_law("FJA", worn)};
  };

  /** The user's law requires mean forces. The message must not name another law. */
  void test_law_that_needs_means()
  {
    struct Needing : Wearing
    {
      bool needs_mean_force() const override { return true; }
    };
    const Column  column = block_at_wall();
    const Needing law;
    JointLaws     laws;
    laws.add(&law, 1.);
    Newmark(column.structure, laws, tight(), .01, ImpactRule::mean_force);
    std::string message;
    try
    {
      Newmark(column.structure, laws, tight(), .01, ImpactRule::paper);
    }
    catch (const InputError &error)
    {
      message = error.what();
    }
    report("a law that needs the rule mean-force: " + message, 0., "-",
           message.find("\"Dynamics/Impact\" to mean-force") != std::string::npos &&
               message.find("cohesive") == std::string::npos);
  }

  /** A saved state must have the history variables of the laws. */
  void test_saved_history()
  {
    const Column  column = block_at_wall();
    const Wearing law;
    JointLaws     laws;
    laws.add(&law, 1.);
    Newmark newmark(column.structure, laws, tight(), .01, ImpactRule::mean_force);
    newmark.start({.1, 0., 0.}, {0., 0., 0.}, {0., 0., 0.}, {0., 0., 0.}, {0., 0., 0.}, {1.});
    DynamicState saved = newmark.state();
    const auto   resume = [&] { newmark.resume(saved, newmark.initial_energy(), 0., {0., 0., 0.}); };
    resume();
    report("history variable of a resumed run", newmark.state().memory[0], "1",
           newmark.state().memory[0] == 1.);
    saved.memory = {1., 0.};
    throws("saved state with another number of history variables", resume, {"has 2", "have 1", "--resume"});
    saved.memory.clear();
    throws("saved state without history variables", resume, {"has 0", "have 1"});
  }

  /** A block of 1 kg hits a wall with a velocity of 1 m/s normal to the wall and 2 m/s along it. The velocity
   * along the wall decreases by the coefficient of friction times 1 m/s. The coefficient is that of the
   * history before the impact. */
  void test_history_at_impact()
  {
    const Column  column = block_at_wall();
    const Wearing law;
    JointLaws     laws;
    laws.add(&law, column.structure.pairs[0].area);
    Unknowns memory = laws.initial_memory();
    for (const double friction : {Wearing::fresh, Wearing::worn})
    {
      Newmark newmark(column.structure, laws, tight(), .01, ImpactRule::mean_force);
      newmark.start({.0234, 0., 0.}, {-1., 2., 0.}, {0., 0., 0.}, {0., 0., 0.}, {0., 0., 0.}, memory);
      for (unsigned int i = 0; i < 6; ++i)
        newmark.advance({0., 0., 0.});
      const Unknowns &v = newmark.state().v;
      below("impact with friction " + text(friction) + ": normal velocity", v[0], 1e-12);
      below("  velocity along the wall - exact", v[1] - (2. - friction), 1e-12);
      memory = newmark.state().memory;
      report("  worn after it", memory[0], "1", memory[0] == 1.);
    }
  }
} // namespace

int main()
{
  return run_all({test_circle, test_changing_pressure, test_small_circle, test_history_at_impact,
                  test_law_that_needs_means, test_saved_history});
}
