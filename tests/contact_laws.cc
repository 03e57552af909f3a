// SPDX-License-Identifier: GPL-3.0-or-later
// The joint laws, pair by pair: generalized Jacobians against finite differences, exact solutions of one
// pair, impulses, units, the measure of convergence, and shear keys against what is known of them.

#include "blocks.h"
#include "natural_map.h"

#include <voussoir/base/error.h>
#include <voussoir/contact/key_law.h>
#include <voussoir/contact/law_table.h>

using namespace Columns;

namespace
{
  struct NamedLaw
  {
    std::string               name;
    std::unique_ptr<JointLaw> law;
    double                    opening = 1.; ///< size of the gaps that are interesting [m]
    double                    friction = 0.;
    KeyParameters             keys = {};
  };

  KeyParameters keys(const double height, const double clearance, const double angle,
                     const std::string &direction, const double friction)
  {
    KeyParameters result;
    result.height = height;
    result.clearance = clearance;
    result.flank_angle = angle;
    result.direction = direction;
    result.friction = friction;
    return result;
  }

  const std::vector<KeyParameters> &key_sets()
  {
    static const std::vector<KeyParameters> list = {
        keys(.7, 0., 0., "both", 0.),        keys(.7, 0., 0., "radial", 0.5),
        keys(.7, .1, 0., "both", 0.5),       keys(.7, 0., 30., "both", 0.),
        keys(.7, .1, 45., "both", 0.3),      keys(.7, 0., 60., "both", 0.6),
        keys(.7, .05, 45., "vertical", 0.3), keys(.7, .1, 30., "radial", 0.6),
        keys(.7, .02, 60., "radial", 0.),    keys(.7, 0., 45., "both", 0.),
        keys(.2, .3, 20., "vertical", 0.9)};
    return list;
  }

  std::string name_of(const KeyParameters &k)
  {
    return "KSM " + text(k.flank_angle) + " deg " + k.direction + ", c " + text(k.clearance) + ", mu " +
           text(k.friction);
  }

  std::vector<NamedLaw> all_laws()
  {
    std::vector<NamedLaw> list;
    const auto            put = [&](const std::string &name, const std::string &equations, const double mu)
    {
      list.push_back({name + " " + equations + (name == "FJA" ? ", mu " + text(mu) : ""),
                      make_joint_law(name, LawParameters(mu, equations_from_name(equations))), 1., mu});
    };
    put("tied", "alart-curnier", .7);
    put("FJB", "alart-curnier", .7);
    for (const std::string equations : {"alart-curnier", "paper"})
      for (const double mu : {0., .3, .7, 2.})
        put("FJA", equations, mu);
    for (const double mu : {0., .8})
      for (KeyParameters k : key_sets())
        for (const double seat : {0., .5})
        {
          k.seat_compliance = seat;
          list.push_back({name_of(k) + ", face " + text(mu) + (seat > 0. ? ", seat" : ""),
                          make_joint_law("KSM", LawParameters(mu, Equations::alart_curnier, k)), k.height, mu,
                          k});
        }
    return list;
  }

  Vector3 random_vector(const double size)
  {
    return {{size * random_number(), size * random_number(), size * random_number()}};
  }

  /** Symmetric positive definite. */
  Matrix3 random_flexibility()
  {
    Matrix3 A, H{};
    for (double &a : A)
      a = random_number();
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int k = 0; k < 3; ++k)
          H[3 * i + j] += A[3 * i + k] * A[3 * j + k] + (i == j && k == 0 ? .1 : 0.);
    return H;
  }

  Vector3 plus(const Vector3 &a, const Vector3 &b)
  {
    return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}};
  }

  /** The start of a step: at rest, anywhere in the keys' play, in their seats but beyond it, or out of them.
   */
  Vector3 random_start(const unsigned int trial)
  {
    Vector3 start = random_vector(.5);
    switch (trial % 4)
    {
    case 0:
      return {};
    case 1: // in their seats
      return {{.05 * (1. + random_number()), .2 * start[1], .2 * start[2]}};
    case 2: // out of line and at or above the crests
      return {{.7 + .3 * std::max(0., random_number()), start[1], start[2]}};
    default:
      return {{.8 * std::abs(start[0]), start[1], start[2]}};
    }
  }

  /** Checks the number of the 2000 random states that exceed a limit: at most @p most, which is zero except where
   * forces are not unique (see SurfacesLaw). */
  void few(const std::string &what, const unsigned int number, const unsigned int most)
  {
    below(what + ", of 2000", number, most + .5);
  }

  /** Returns the permitted number of states with several forces: more where the face's friction is above what a
   *  flank needs to ride, or the flanks' friction jams the key. */
  unsigned int ambiguous(const NamedLaw &l)
  {
    if (l.keys.friction == 0. && (l.friction == 0. || l.keys.flank_angle == 0.))
      return 0;
    const double a = l.keys.flank_angle * pi / 180., needed = .5 * pi - a + std::atan(l.keys.friction);
    if (l.keys.friction < l.friction && std::atan(l.friction) > needed)
      return 200;
    return 40;
  }

  void test_derivatives()
  {
    const double h = 2e-6;
    for (const NamedLaw &l : all_laws())
    {
      random_engine().seed(7); // the place of a law has no effect on the others
      double             worst = 0.;
      unsigned int       kinks = 0, wrong = 0, states[3] = {0, 0, 0};
      std::map<int, int> touching;
      const unsigned int n = 2000;
      const bool         has_keys = l.name.find("KSM") == 0;
      if (has_keys && l.keys.seat_compliance == 0.)
        continue; // those of a numerical compliance: stiff
      for (unsigned int trial = 0; trial < n; ++trial)
      {
        const Vector3 start = random_start(trial);
        Vector3       x[2] = {random_vector(1.), plus(start, random_vector(.5))};
        const double  rho = std::pow(10., random_number());
        PairEquations e, forward, backward;
        l.law->evaluate(x[0], x[1], start, rho, e);
        if (l.name.find("paper") != std::string::npos && std::hypot(x[0][1], x[0][2]) < .1)
          continue; // the angle of the force turns ever faster
        double error = 0., jump = 0.;
        bool   same = true;
        for (unsigned int k = 0; k < 2; ++k)
          for (unsigned int j = 0; j < 3; ++j)
          {
            const double kept = x[k][j];
            x[k][j] = kept + h;
            l.law->evaluate(x[0], x[1], start, rho, forward);
            x[k][j] = kept - h;
            l.law->evaluate(x[0], x[1], start, rho, backward);
            x[k][j] = kept;
            if (!has_keys) // where surfaces are redundant, round-off may decide which of them touch
              same = same && forward.state == e.state && backward.state == e.state;
            for (unsigned int i = 0; i < 3; ++i)
            {
              const double up = (forward.residual[i] - e.residual[i]) / h,
                           down = (e.residual[i] - backward.residual[i]) / h;
              jump = std::max(jump, std::abs(up - down) / (1. + rho));
              error = std::max(error, std::abs(.5 * (up + down) - (k == 0 ? e.d_force : e.d_gap)[3 * i + j]) /
                                          (1. + rho));
            }
          }
        // A kink within h; it must be rare.
        if (!same || jump > 1e-3)
        {
          ++kinks;
          continue;
        }
        ++states[static_cast<int>(e.state)];
        ++touching[e.active];

        if (has_keys && !(error < 2e-6))
          ++wrong;
        else
          worst = std::max(worst, error);
      }
      below("derivatives, " + l.name, worst, 2e-6);
      below("  of " + text(n) + " points, near kinks", kinks, .02 * n);
      if (has_keys)
        few("  with another derivative", wrong, 0);
      const bool is_tied = l.name.find("tied") == 0, is_FJB = l.name.find("FJB") == 0;
      if (!is_tied)
        above("  open, sticking, slipping points: the fewest",
              is_FJB ? std::min(states[0], states[1]) : *std::min_element(states, states + 3),
              l.name.find("mu 0") == std::string::npos ? 20 : -1);
      if (has_keys)
        above("  different sets of surfaces that touch", touching.size(), 4);
    }
  }

  /** Returns the error of the surfaces of a pair at its solution @p f, plus the distance of f from the sum of their
   * forces. */
  double surfaces_error(const SurfacesLaw &law, const Matrix3 &H, const Vector3 &b, const Vector3 &start,
                        const Vector3 &f, const double rho)
  {
    std::vector<double> beside;
    const Vector3       force = solve_surfaces(law.present(start), H, b, &beside), gap = plus(H * f, b);
    PairSurfaces        pair;
    pair.start(law.present(start), rho, 1. / rho);
    return norm(force - f) + std::sqrt(pair.error_square(f, gap, beside.data(), rho, true));
  }

  /** The exact solution of one pair makes the equations zero, whatever rho and formulation. */
  void test_solve()
  {
    for (const NamedLaw &l : all_laws())
    {
      random_engine().seed(7); // the place of a law has no effect on the others
      double       worst_equations = 0., worst_error = 0.;
      unsigned int wrong = 0;
      const bool   has_keys = l.name.find("KSM") == 0;
      for (unsigned int trial = 0; trial < 2000; ++trial)
      {
        const Matrix3 H = random_flexibility();
        const Vector3 start = random_start(trial), b = plus(start, random_vector(1.)),
                      f = l.law->solve(H, b, start), gap = plus(H * f, b);
        const double scale = 1. + norm(f);
        double       equations = 0., error = 0.;
        for (const double rho : {.1, 1., 10.})
        {
          if (has_keys)
          {
            equations = std::max(equations, surfaces_error(*l.law->surfaces_law(), H, b, start, f, rho) /
                                                scale / (1. + rho));
            continue;
          }
          PairEquations e;
          l.law->evaluate(f, gap, start, rho, e);
          if (l.name.find("paper") == std::string::npos || std::hypot(f[1], f[2]) > 1e-6)
            equations = std::max(equations, norm(e.residual) / scale / (1. + rho));
          error = std::max(error, norm(l.law->error(f, gap, start, rho)) / scale / (1. + rho));
        }
        if (has_keys && !(equations < 1e-11))
          ++wrong;
        else
        {
          worst_equations = std::max(worst_equations, equations);
          worst_error = std::max(worst_error, error);
        }
      }
      below("one pair alone, " + l.name + ": equations", worst_equations, 1e-11);
      below("  error", worst_error, 1e-11);
      if (has_keys)
        few("  not solved", wrong, ambiguous(l));
    }
  }

  /** Impulses take energy, stop_normal, too; the impulse satisfies the law for velocities. */
  void test_impulses()
  {
    for (const NamedLaw &l : all_laws())
    {
      random_engine().seed(7); // the place of a law has no effect on the others
      double       gain = 0., gain_stop = 0., approach = 0.;
      unsigned int wrong = 0;
      for (unsigned int trial = 0; trial < 3000; ++trial)
      {
        const Matrix3       H = random_flexibility();
        const Vector3       v = random_vector(1.);
        const bool          has_keys = l.name.find("KSM") == 0;
        const unsigned char touching = has_keys ? trial % 8 : trial % 2;
        const Vector3       I = l.law->solve_impulse(H, v, {}, touching), after = plus(v, H * I);
        const double        size = norm(I) * (norm(v) + norm(after));
        gain = std::max(gain, .5 * dot(I, plus(v, after)) / (1e-300 + size));
        if ((touching & 1) && has_keys && after[0] < -1e-10)
          ++wrong;
        else if (touching & 1)
          approach = std::max(approach, -after[0]);
        if (l.law->is_tangentially_tied())
          continue;
        const Vector3 spent = l.law->solve_impulse(H, random_vector(1.), {}, touching);
        const Vector3 f = l.law->stop_normal(H, v, spent, touching) - spent;
        gain_stop = std::max(gain_stop, .5 * dot(f, plus(v, plus(v, H * f))) / (1e-300 + norm(f) * norm(v)));
      }
      below("impulse, " + l.name + ": energy gained / size", gain, 1e-10);
      below("  approach of touching faces", approach, 1e-10);
      if (wrong > 0)
        few("  not stopped", wrong, 0);
      below("  energy gained by stop_normal / size", gain_stop, 1e-10);
    }
  }

  /** Lengths and forces in other units: the same equations, times the unit of force. */
  void test_units()
  {
    double       worst = 0., worst_solve = 0.;
    unsigned int other_solutions = 0;
    for (const double L : {1e3, 1e-4})
      for (const double F : {1e-6, 1e5})
        for (const KeyParameters &k : key_sets())
        {
          KeyParameters scaled = k;
          scaled.height *= L;
          scaled.clearance *= L;
          const auto law = make_joint_law("KSM", LawParameters(.6, Equations::alart_curnier, k)),
                     other = make_joint_law("KSM", LawParameters(.6, Equations::alart_curnier, scaled));
          const auto times = [](const double s, const Vector3 &x) -> Vector3 {
            return {{s * x[0], s * x[1], s * x[2]}};
          };
          for (unsigned int trial = 0; trial < 200; ++trial)
          {
            const Vector3 start = random_start(trial), force = random_vector(1.),
                          gap = plus(start, random_vector(.5));
            PairEquations e, s;
            law->evaluate(force, gap, start, 1.3, e);
            other->evaluate(times(F, force), times(L, gap), times(L, start), 1.3 * F / L, s);
            worst = std::max(worst, norm(times(1. / F, s.residual) - e.residual));
            Matrix3       H = random_flexibility();
            const Vector3 b = plus(start, random_vector(1.)), f = law->solve(H, b, start);
            for (double &x : H)
              x *= L / F;
            const Vector3 g = other->solve(H, times(L, b), times(L, start));
            const double  apart = norm(times(1. / F, g) - f) / (1. + norm(f));
            if (apart > 1e-10)
              ++other_solutions;
            else
              worst_solve = std::max(worst_solve, apart);
          }
        }
    below("KSM in other units: equations", worst, 1e-10); // the forces are found to 1e-13 of what moves them
    below("KSM in other units: one pair alone", worst_solve, 1e-10);
    few("KSM in other units: other solutions of one pair", other_solutions * 2000 / 8800, 0);
  }

  /** The measure of convergence: the same for all formulations; for FJA Siconos' formula, written anew. */
  void test_error()
  {
    double between_forms = 0., to_siconos = 0.;
    for (const double mu : {0., .3, 1., 3.})
    {
      const auto law = make_joint_law("FJA", mu),
                 paper = make_joint_law("FJA", LawParameters(mu, Equations::paper));
      for (unsigned int trial = 0; trial < 4000; ++trial)
      {
        const Vector3 r = random_vector(1.), gap = random_vector(1.), start = random_start(trial);
        const double  rho = std::pow(10., random_number());
        const Vector3 e = law->error(r, gap, start, rho);
        between_forms = std::max(between_forms, norm(paper->error(r, gap, start, rho) - e));
        const Vector3 u = {{rho * gap[0], rho * (gap[1] - start[1]), rho * (gap[2] - start[2])}};
        to_siconos = std::max(to_siconos, norm(natural_map_of_contact(r, u, mu) - e));
      }
    }
    below("error of FJA: difference between the formulations", between_forms, 1e-15);
    below("error of FJA: difference from Siconos' natural map", to_siconos, 1e-13);
  }

  /** Keys without height have no effect. */
  void test_no_keys()
  {
    double worst = 0., solution = 0., impulse = 0.;
    for (const double mu : {0., .4, 1.2})
    {
      const auto flat = make_joint_law("FJA", mu),
                 law = make_joint_law(
                     "KSM", LawParameters(mu, Equations::alart_curnier, keys(0., .01, 30., "both", .5)));
      for (unsigned int trial = 0; trial < 3000; ++trial)
      {
        const Vector3 start = random_start(trial), force = random_vector(1.),
                      gap = plus(start, random_vector(1.));
        PairEquations a, b;
        flat->evaluate(force, gap, start, 1.7, a);
        law->evaluate(force, gap, start, 1.7, b);
        worst = std::max(worst, norm(a.residual - b.residual));
        for (unsigned int k = 0; k < 9; ++k)
          worst = std::max({worst, std::abs(a.d_force[k] - b.d_force[k]), std::abs(a.d_gap[k] - b.d_gap[k])});
        worst = std::max(worst, a.state == b.state && a.active == b.active ? 0. : 1.);
        const Matrix3 H = random_flexibility();
        const Vector3 f = flat->solve(H, gap, start);
        solution = std::max(solution, norm(law->solve(H, gap, start) - f) / (1. + norm(f)));
        impulse =
            std::max(impulse, norm(law->solve_impulse(H, gap, {}, 1) - flat->solve_impulse(H, gap, {}, 1)) /
                                  (1. + norm(f)));
      }
    }
    below("keys of no height against FJA: equations and Jacobian", worst, 1e-14);
    below("keys of no height against FJA: one pair alone", solution, 1e-12);
    below("keys of no height against FJA: impulse", impulse, 1e-12);
  }

  /** Tight rectangular keys hold both tangential directions: FJB. */
  void test_rectangular()
  {
    const auto FJB = make_joint_law("FJB", 0.),
               law = make_joint_law(
                   "KSM", LawParameters(0., Equations::alart_curnier, keys(.7, 0., 0., "both", 0.)));
    double worst = 0., slip = 0.;
    for (unsigned int trial = 0; trial < 5000; ++trial)
    {
      const Matrix3 H = random_flexibility();
      const Vector3 start = {{trial % 2 ? .3 * (1. + random_number()) : 0., 0., 0.}}, b = random_vector(1.);
      const Vector3 f = law->solve(H, b, start), g = FJB->solve(H, b, start), gap = plus(H * f, b);
      worst = std::max(worst, norm(f - g) / (1. + norm(g)));
      slip = std::max(slip, std::hypot(gap[1], gap[2]));
    }
    below("tight rectangular keys against FJB: one pair alone", worst, 1e-12);
    below("tight rectangular keys: slip", slip, 1e-12);
  }

  /** A step that starts within round-off of a flank starts on it: the direction of friction must not hang on
   *  the 1e-14 m that are left of the play, which all iterations did not find.
   */
  void test_start_on_flank()
  {
    double worst = 0., worst_solve = 0.;
    for (const KeyParameters &k : {keys(.2, 0., 0., "both", 0.), keys(.2, 0., 0., "both", .5),
                                   keys(.2, .005, 0., "both", 0.), keys(.2, .005, 0., "radial", .5)})
    {
      const auto law = make_joint_law("KSM", LawParameters(.8, Equations::alart_curnier, k));
      for (unsigned int trial = 0; trial < 2000; ++trial)
      {
        const double  rho = 1e11;
        const Vector3 exact = {{0., trial % 2 ? k.clearance : -k.clearance, 0.}};
        Vector3       start = plus(exact, random_vector(1e-14));
        if (k.clearance > 0.)
          start[2] = 0.; // far from the other flanks the slip of the step counts as it is
        const Vector3 force = random_vector(5e8), gap = plus(exact, random_vector(1e-3));
        PairEquations a, b;
        law->evaluate(force, gap, start, rho, a);
        law->evaluate(force, gap, exact, rho, b);
        worst = std::max(worst, norm(a.residual - b.residual) / (rho * 1e-3));
        Matrix3 H = random_flexibility();
        for (double &h : H)
          h *= 1e-11;
        const Vector3 offset = plus(exact, random_vector(1e-3));
        const Vector3 f = law->solve(H, offset, start), g = law->solve(H, offset, exact);
        worst_solve = std::max(worst_solve, norm(f - g) * 1e-8);
      }
    }
    below("start within round-off of a flank: equations", worst, 1e-13);
    below("start within round-off of a flank: one pair alone", worst_solve, 1e-12);
  }

  /** Frictionless keys are a convex set of gaps: f (gap' - gap) >= 0 for every other gap' of it. */
  void test_variational()
  {
    double worst = 0., outside = 0.;
    for (const KeyParameters &parameters : key_sets())
    {
      KeyParameters k = parameters;
      k.friction = 0.;
      const auto   law = make_joint_law("KSM", LawParameters(0., Equations::alart_curnier, k));
      const double a = k.flank_angle * pi / 180., s = std::sin(a), c = std::cos(a);
      const auto   least = [&](const Vector3 &g) // of the distances to all surfaces
      {
        double result = g[0];
        for (const unsigned int d : {1, 2})
          if (k.direction == "both" || (k.direction == "radial") == (d == 1))
            result = std::min(result, g[0] * s - std::abs(g[d]) * c + k.clearance);
        return result;
      };
      for (unsigned int trial = 0; trial < 1000; ++trial)
      {
        const Matrix3 H = random_flexibility();
        const Vector3 b = random_vector(1.), f = law->solve(H, b, {}), gap = plus(H * f, b);
        outside = std::max(outside, -least(gap));
        for (unsigned int other = 0; other < 20; ++other)
        {
          Vector3 g = random_vector(.5 * (other + 1.));
          g[0] = std::abs(g[0]);
          for (const unsigned int d : {1, 2}) // into the play
          {
            const double play = (g[0] * s + k.clearance) / c;
            if (k.direction == "both" || (k.direction == "radial") == (d == 1))
              g[d] = other % 3 == 0 ? std::copysign(play, g[d]) : std::max(-play, std::min(play, g[d]));
          }
          worst = std::max(worst, -dot(f, g - gap) / (norm(f) * (norm(g) + norm(gap)) + 1e-300));
        }
      }
    }
    below("frictionless keys: penetration of any surface", outside, 1e-12);
    below("frictionless keys: force against an admissible motion", worst, 1e-13);
  }

  /** Play, dilation, keys out of their seats, keys on their crests. */
  void test_kinematics()
  {
    const auto make = [](const KeyParameters &k)
    { return make_joint_law("KSM", LawParameters(0., Equations::alart_curnier, k)); };
    double play = 0., dilation = 0.;
    for (const double angle : {0., 15., 30., 45., 60., 80.})
      for (const double clearance : {0., .002})
        for (const double sign : {1., -1.})
          for (const unsigned int d : {1, 2})
          {
            const double a = angle * pi / 180., extra = clearance / std::cos(a);
            const auto   law = make(keys(.2, clearance, angle, "both", 0.));
            Vector3      b = {{.005, 0., 0.}};
            b[d] = sign * .5;
            Matrix3 H = {{1e-9, 0., 0., 0., 1., 0., 0., 0., 1.}}; // the opening cannot change
            Vector3 gap = plus(H * law->solve(H, b, {}), b);
            play = std::max(play, std::abs(sign * gap[d] - (gap[0] * std::tan(a) + extra)));
            play = std::max(play, std::abs(sign * gap[d] - (.005 * std::tan(a) + extra)) > 1e-6 ? 1. : 0.);
            if (angle == 45. && clearance == 0. && sign > 0. && d == 1)
              below("keys of 45 degrees open by 5 mm: play - 5 mm", 1e3 * (gap[1] - .005), 1e-5);
            if (angle == 0.)
              continue;
            b = {{-.001, 0., 0.}};
            b[d] = sign * .01;
            H = {{1., 0., 0., 0., 1e-4, 0., 0., 0., 1e-4}}; // the slip is nearly forced
            gap = plus(H * law->solve(H, b, {}), b);
            dilation =
                std::max({dilation, std::abs(gap[0] - std::max(0., (sign * gap[d] - extra) / std::tan(a))),
                          std::abs(gap[0] - std::max(0., (.01 - extra) / std::tan(a))) > 1e-4 ? 1. : 0.});
          }
    below("play of the keys - (g tan a + c/cos a) [m]", play, 1e-12);
    below("dilation under forced slip - (|d| - c/cos a)/tan a [m]", dilation, 1e-12);

    double freedom = 0., crest = 0., on_crest_friction = 0., after = 0.;
    for (const double angle : {0., 30., 60.})
      for (const double friction : {0., .5})
      {
        const KeyParameters k = keys(.2, .001, angle, "both", .3);
        const auto          law = make_joint_law("KSM", LawParameters(friction, Equations::alart_curnier, k));
        const Matrix3       H = random_flexibility();
        for (const double slip : {.0, .6, -.9})
        {
          // open by more than their height: free to slip
          const Vector3 start = {{.2001, slip, .3 * slip}};
          freedom = std::max(freedom, norm(law->solve(H, {{.25, slip + 5., -3.}}, start)));
          // in line they close; out of line they ride on their crests, with the friction of the face
          const Vector3 b = {{-.3, slip + .1, -.2}}, f = law->solve(H, b, start), gap = plus(H * f, b);
          crest = std::max(crest, std::abs(gap[0] - (slip == 0. ? 0. : .2)));
          on_crest_friction = std::max(on_crest_friction, std::hypot(f[1], f[2]) - friction * f[0]);
          // and on, from there
          const Vector3 next = plus(gap, {{-.3, .05, .02}}), g = law->solve(H, next, gap);
          if (slip != 0.)
            after = std::max(after, std::abs(plus(H * g, next)[0] - .2));
        }
      }
    below("keys out of their seats: force", freedom, 1e-300);
    below("keys out of line: opening - height [m]", crest, 1e-12);
    below("keys on their crests: excess over Coulomb's limit", on_crest_friction, 1e-12);
    below("keys on their crests, next step: opening - height [m]", after, 1e-12);
  }

  /** Keys without a friction of their own have that of the face, which leaves few states with several forces
   *  where flanks without friction would leave many. */
  void test_default_friction()
  {
    for (const double angle : {0., 45., 60.})
    {
      KeyParameters k;
      k.height = .7;
      k.flank_angle = angle;
      const double mu = .8;
      const auto   law = make_joint_law("KSM", LawParameters(mu, Equations::alart_curnier, k));
      k.friction = mu;
      const auto   same = make_joint_law("KSM", LawParameters(mu, Equations::alart_curnier, k));
      double       difference = 0.;
      unsigned int not_solved = 0;
      for (unsigned int trial = 0; trial < 2000; ++trial)
      {
        const Matrix3 H = random_flexibility();
        const Vector3 start = random_start(trial), b = plus(start, random_vector(1.)),
                      f = law->solve(H, b, start), gap = plus(H * f, b);
        difference = std::max(difference, norm(f - same->solve(H, b, start)));
        PairEquations e, e_same;
        law->evaluate(f, gap, start, 1., e);
        same->evaluate(f, gap, start, 1., e_same);
        difference = std::max(difference, norm(e.residual - e_same.residual));
        not_solved += !(surfaces_error(*law->surfaces_law(), H, b, start, f, 1.) < 1e-11 * (1. + norm(f)));
      }
      const std::string what = "keys of " + text(angle) + " deg, friction not given: ";
      below(what + "difference from the face's", difference, 1e-300);
      few(what + "not solved", not_solved, 40);
    }
    for (const double friction : {-.5, -2., std::nan("")})
    {
      std::string message;
      try
      {
        make_joint_law("KSM",
                       LawParameters(.8, Equations::alart_curnier, keys(.2, 0., 0., "both", friction)));
      }
      catch (const InputError &error)
      {
        message = error.what();
      }
      report("keys with friction " + text(friction), friction, "refused",
             message.find("Joints/Keys/Friction") != std::string::npos);
    }
  }

  /** Elastic seats: stiff in series, friction that remembers, flanks that are passed by. */
  void test_seats()
  {
    KeyParameters k = keys(.2, .001, 0., "radial", .5);
    k.seat_compliance = 1e-10;
    const double area = 3.;
    const auto   law = make_joint_law("KSM", LawParameters(0., Equations::alart_curnier, k));
    double       memory[6] = {};
    PairHistory  past;
    past.area = area;
    past.memory = memory;
    past.start = {{.01, 0., 0.}};
    // Moved by 5 mm along the key's play of 1 mm, against a spring.
    const double  spring = 2e-11; // [m/N]
    const Matrix3 H = {{spring, 0., 0., 0., spring, 0., 0., 0., spring}};
    Vector3       b = {{.01, .005, 0.}}, f = law->solve(H, b, past), gap = plus(H * f, b);
    const double  expected = -(.005 - .001) / (spring + k.seat_compliance / area);
    below("elastic seat: force of spring and seat in series", f[1] / expected - 1., 1e-12);
    below("  play and deformation of the seat [m]", gap[1] - .001 + f[1] * k.seat_compliance / area, 1e-14);
    law->commit(f, gap, past, memory);
    below("  energy of the seat", law->bond_energy(gap, area, memory) / (.5 * (gap[1] - .001) * -f[1]) - 1.,
          1e-12);
    const auto friction = [&](const Vector3 &force, const Vector3 &end)
    {
      const Vector3 moved = end - past.start;
      return law->surfaces_law()->friction_correction(force, end, past) - force[1] * moved[1] -
             force[2] * moved[2];
    };
    below("  the normal work of the flank is no friction", friction(f, gap) / (f[1] * gap[1]), 1e-14);
    // Along the flank: elastic until friction is spent, and back by as much.
    past.start = gap;
    const double limit = -.5 * f[1], give = limit * k.seat_compliance / area;
    b = gap - H * f;
    b[0] += .4 * give + spring * .4 * limit; // pulled open along the flank
    Vector3 g = law->solve(H, b, past), there = plus(H * g, b);
    below("  friction of the seat before it slips", (-g[0]) / (.4 * limit) - 1., 1e-9);
    below("  its deformation", (there[0] - gap[0]) / (.4 * give) - 1., 1e-9);
    // The force at the end of the step has twice the work that the seat stores.
    below("  what friction takes", friction(g, there) / (.5 * .4 * .4 * limit * give) - 1., 1e-8);
    law->commit(g, there, past, memory);
    past.start = there;
    below("  what it takes where it slips by twice the deformation, less what the seat stores",
          friction({{-limit, f[1], 0.}}, {{there[0] + 2. * give, there[1], 0.}}) /
                  ((2. - .5 * (1. - .4 * .4)) * limit * give) -
              1.,
          1e-8);
    const Vector3 held = law->solve({{1e-30, 0., 0., 0., 1e-30, 0., 0., 0., 1e-30}}, there, past);
    below("  it stays while nothing moves", norm(held - g) / norm(g), 1e-9);
    // Out of the seat, next to it, and back: the flank is found again where it was.
    const auto go = [&](const Vector3 &to)
    {
      const Vector3 force = law->solve({{1e-30, 0., 0., 0., 1e-30, 0., 0., 0., 1e-30}}, to, past);
      law->commit(force, to, past, memory);
      past.start = to;
      return norm(force);
    };
    below("  force out of the seat", (go({{.3, .005, 0.}}), go({{.3, .05, 0.}}) + go({{.3, 0., 0.}})),
          1e-300);
    below("  back in its play", go({{.15, 0., 0.}}), 1e-3);
    below("  pressed by the elastic 1 mm again", go({{.15, .002, 0.}}) / (.001 * area / 1e-10) - 1., 1e-9);
  }

  /** One pair with keys that the joint's motion leads, closed by a spring. */
  struct LedKey
  {
    std::unique_ptr<JointLaw> law;
    std::vector<double>       memory;
    PairHistory               past;

    LedKey(const KeyParameters &k, const double friction)
        : law(make_joint_law("KSM", LawParameters(friction, Equations::alart_curnier, k))),
          memory(law->n_memory(), 0.)
    {
      past.memory = memory.data();
    }

    /** The opening after a step that leads the slip to @p slip, where the joint would open by @p free. */
    double step(const double free, const double slip)
    {
      const Matrix3 H = {{1., 0., 0., 0., 1e-9, 0., 0., 0., 1e-9}};
      const Vector3 b = {{free, slip, 0.}};
      for (unsigned int events = 0; events < 10; ++events)
      {
        const Vector3 force = law->solve(H, b, past), gap = plus(H * force, b);
        if (law->utilisation(force, gap, past) > 1.)
        {
          law->apply_event(memory.data());
          continue;
        }
        law->commit(force, gap, past, memory.data());
        past.start = gap;
        return gap[0];
      }
      return std::numeric_limits<double>::quiet_NaN();
    }
  };

  /** A key that is out closes while it moves sideways: its flank stops it, and the compression of an elastic
   * seat does not count as a way over the end of the flank. */
  void test_back_onto_elastic_seat()
  {
    constexpr double height = .15, side = 1e-3, flexibility = 1e-9;
    double           compression = 0.;
    for (const double seat : {1e-12, 20. * height / 21e9})
    {
      LawParameters p(0.);
      p.keys = keys(height, 0., 0., "radial", 0.);
      p.keys.seat_compliance = seat;
      const auto          law = make_joint_law("KSM", p);
      std::vector<double> memory(law->n_memory(), 0.);
      PairHistory         past(Vector3{{.16, 0., 0.}});
      past.area = 1.;
      past.memory = memory.data();
      const Matrix3 H = {{flexibility, 0., 0., 0., flexibility, 0., 0., 0., flexibility}};
      for (const double sign : {1., -1.})
      {
        const Vector3 b = {{.05, sign * side, 0.}};
        memory[0] = 0.;
        expect(law->utilisation({}, b, past) > 1., "past the flank: the next event");
        memory[0] = 1.;
        const Vector3 force = law->solve(H, b, past), gap = plus(b, H * force);
        compression =
            std::max(compression, std::abs(std::abs(gap[1]) - side * seat / (seat + flexibility)) / side);
        expect(std::abs(gap[0] - .05) < 1e-12, "the opening is free");
        expect(law->utilisation(force, gap, past) == 0., "stopped by its flank, not on its crest");
      }
    }
    below("key on its elastic seat again: compression, relative error", compression, 1e-9);
  }

  /** A rectangular key that leaves its socket with a compressed elastic flank closes in the socket again. A key
   * that moves beyond the end of the flank, before or after it leaves, closes on its crest. */
  void test_out_of_compressed_seat()
  {
    constexpr double height = .2, side = 1e-3;
    KeyParameters    k = keys(height, 0., 0., "radial", 0.);
    k.seat_compliance = 1e-9;
    const auto opening = [&](const double beyond)
    {
      LedKey key(k, 0.);
      key.past.area = 1.;
      key.step(.9 * height, side);
      key.step(1.01 * height, side);
      const double slip = key.past.start[1] + beyond;
      key.step(1.2 * height, slip);
      return key.step(-.1, beyond == 0. ? 0. : slip);
    };
    below("rectangular key, out of its compressed socket: opening after closing [m]", std::abs(opening(0.)),
          1e-9);
    below("rectangular key, 1 mm further: opening after closing - height [m]",
          std::abs(opening(side) - height), 1e-9);
    // Up an inclined flank and over its end in one step, then closed at the same place.
    k.flank_angle = 45.;
    LedKey       key(k, 0.);
    const double corner = height * std::tan(.25 * pi);
    key.step(-.1, .9 * corner);
    key.step(-.1, corner + 10. * side);
    key.step(1.2 * height, corner + 10. * side);
    below("key of 45 deg, over the end of its flank: opening after closing - height [m]",
          std::abs(key.step(-.1, corner + 10. * side) - height), 1e-9);
    // The same, but the key leaves the flank before its end and goes beyond the end in the same step.
    LedKey away(k, 0.);
    away.step(-.1, .9 * corner);
    away.step(1.2 * height, corner + 10. * side);
    below("key of 45 deg, off its flank and beyond the end: opening after closing - height [m]",
          std::abs(away.step(-.1, corner + 10. * side) - height), 1e-9);
  }

  /** A key that is pulled out, goes over its flank and comes back: its crest and its flank stop it from
   * below, whatever the steps. */
  void test_out_over_and_back()
  {
    constexpr double height = .2;
    for (const double angle : {30., 45., 60., 75.})
      for (const double seat : {0., 1e-12})
        for (const unsigned int steps : {1, 4, 100})
        {
          KeyParameters k = keys(height, 0., angle, "radial", 0.);
          k.seat_compliance = seat;
          LedKey       key(k, 0.);
          const double t = std::tan(angle * pi / 180.), corner = height * t;
          double       through = 0., crest = 0., lifted = 0., end = 0.;
          const auto   lead = [&](const double free, const double from, const double to)
          {
            for (unsigned int i = 1; i <= steps; ++i)
            {
              const double slip = from + (to - from) * i / steps, g = key.step(free, slip),
                           lowest = std::min(slip / t, height); // of the key's profile
              through = std::max(through, lowest - g);
              end = g;
              // The crest holds a key for the rest of the step in which it comes in line.
              lifted = std::max(lifted, g - std::max(free, std::min((std::abs(to - from) / steps + slip) / t,
                                                                    std::max(height, slip / t))));
            }
          };
          lead(1.5 * height, 0., 0.);
          lead(1.5 * height, 0., 1.4 * corner);
          lead(-.1, 1.4 * corner, 1.4 * corner);
          crest = std::abs(end - height);
          lead(-.1, 1.4 * corner, .95 * corner);
          key.step(-.1, .95 * corner);
          const double on_flank = key.past.start[0] - .95 * height;
          lead(-.1, .95 * corner, 0.);
          const std::string what = "keys of " + text(angle) + " deg, out, over and back in " + text(steps) +
                                   " steps, seats " + text(seat) + ": ";
          below(what + "through the flank [m]", through, 1e-9);
          below(what + "opening on the crest - height [m]", crest, 1e-9);
          below(what + "opening on the flank - 0.95 height [m]", on_flank, 1e-9);
          below(what + "above profile and crest [m]", lifted, 1e-9);
          below(what + "opening at the end [m]", key.step(-.1, 0.), 1e-9);
          // From the crest's height beside the flank, in one step.
          LedKey back(k, 0.);
          back.step(height, 0.);
          back.step(height, .95 * corner);
          below(what + "falls to the flank: opening - 0.95 height [m]",
                back.step(-.1, .95 * corner) - .95 * height, 1e-9);
          // Closing and moving over the corner in one step.
          back.step(height, 0.);
          back.step(height, .95 * corner);
          below(what + "closes over the corner: opening - height [m]", back.step(-.1, 1.3 * corner) - height,
                1e-9);
        }
  }

  JointLaws laws_of(const Structure &structure, const std::string &name, const double mu,
                    const KeyParameters &k)
  {
    JointLaws laws;
    for (unsigned int j = 0; j < structure.n_joints; ++j)
      laws.of_joint.push_back(make_joint_law(name, LawParameters(mu, Equations::alart_curnier, k)));
    laws.assign(structure);
    return laws;
  }

  /** Two structures that must behave alike, in statics and in time. */
  void compare(const std::string &what, const std::array<std::string, 2> &name, const double mu,
               const KeyParameters &k)
  {
    const SolidModel  model(blocks(3, false), 1);
    const Structure   structure = with_joints(model, {Material()});
    const JointLaws   laws[2] = {laws_of(structure, name[0], mu, k), laws_of(structure, name[1], mu, k)};
    const std::size_t n = structure.pairs.size();
    double            statics = 0.;
    JointSystem       a(structure, laws[0], tight(), {1e6, .8}), b(structure, laws[1], tight(), {1e6, .8});
    for (unsigned int trial = 0; trial < 5; ++trial)
    {
      Unknowns load(3 * structure.n_nodes()), offset(3 * n), none(3 * n, 0.);
      for (double &f : load)
        f = 1e7 * random_number();
      for (double &d : offset)
        d = 2e-3 * random_number();
      Unknowns   force[2] = {none, none}, gap[2], u[2];
      const bool good = a.solve(load, offset, none, force[0], gap[0], u[0]).converged &&
                        b.solve(load, offset, none, force[1], gap[1], u[1]).converged;
      report(what + ": both converged", trial, "", good);
      for (std::size_t i = 0; i < u[0].size(); ++i)
        statics = std::max(statics, std::abs(u[0][i] - u[1][i]) / largest(u[0]));
    }
    {
      const double   dt = 2e-4;
      const Unknowns none(3 * n, 0.), rest(3 * structure.n_nodes(), 0.);
      Newmark        x(structure, laws[0], tight(), dt, ImpactRule::mean_force),
          y(structure, laws[1], tight(), dt, ImpactRule::mean_force);
      x.start(rest, rest, none, rest, none);
      y.start(rest, rest, none, rest, none);
      Unknowns amplitude(rest), load(rest);
      for (double &f : amplitude)
        f = 5e4 * random_number();
      double most = 0., opened = 0., difference = 0., velocity = 0., fastest = 0.;
      for (unsigned int i = 0; i < 100; ++i)
      {
        for (std::size_t j = 0; j < load.size(); ++j)
          load[j] = amplitude[j] * std::sin(2. * pi * (150. + j % 7) * (i + 1) * dt);
        x.advance(load);
        y.advance(load);
        for (std::size_t j = 0; j < load.size(); ++j)
        {
          difference = std::max(difference, std::abs(x.state().u[j] - y.state().u[j]));
          velocity = std::max(velocity, std::abs(x.state().v[j] - y.state().v[j]));
        }
        most = std::max(most, largest(x.state().u));
        fastest = std::max(fastest, largest(x.state().v));
        for (std::size_t p = 0; p < n; ++p)
          opened = std::max(opened, x.opening_and_slip(p)[0]);
      }
      above(what + ": opening in time / displacement", opened / most, 1e-3);
      below(what + ": displacements", difference / most, 1e-9);
      below(what + ": velocities", velocity / fastest, 1e-9);
      below(what + ": energy account", y.energy_error(), 1e-10);
    }
    below(what + ": displacements in statics", statics, 1e-9);
  }

  void test_structures()
  {
    compare("tight keys and FJB", {"FJB", "KSM"}, 0., keys(.2, 0., 0., "both", 0.));
    compare("no keys and FJA", {"FJA", "KSM"}, .5, keys(0., 0., 0., "both", 0.));
  }
} // namespace

int main()
{
  return run_all({test_units, test_error, test_no_keys, test_rectangular, test_variational, test_kinematics,
                  test_structures, test_start_on_flank, test_default_friction, test_seats,
                  test_out_over_and_back, test_back_onto_elastic_seat, test_out_of_compressed_seat,
                  test_derivatives, test_solve, test_impulses});
}
