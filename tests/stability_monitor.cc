// SPDX-License-Identifier: GPL-3.0-or-later
// The bounds that a run is watched with: against closed forms, and against oscillators on random ground.

#include "column.h"

#include <voussoir/base/error.h>
#include <voussoir/foundation/explicit_rock.h>
#include <voussoir/motion/motion.h>
#include <voussoir/output/energy_check.h>
#include <voussoir/output/stability_monitor.h>

namespace
{
  using namespace Columns;

  /** A cosine of the acceleration in x for whole periods: v = a/w sin(wt), u = a/w^2 (1 - cos(wt)). */
  void sine()
  {
    const double w = 2. * pi, a = 3.;
    GroundMotion motion;
    motion.dt = 1e-3;
    for (unsigned int k = 0; k <= 5000; ++k)
      motion.acceleration.push_back({{a * std::cos(w * k * motion.dt), 0., 0.}});
    const MotionBounds b = bounds_of(motion, 0.);
    between("PGV of a cosine / exact", b.velocity * w / a, .9999, 1.0001);
    between("PGD / exact", b.displacement * w * w / (2. * a), .9999, 1.0001);
    between("sum of |a| dt / exact", b.oscillator / (5. * a * 2. / pi), .9999, 1.0001);
  }

  /** A constant acceleration: the sum of |a| dt with the decay of half of the damping. */
  void constant()
  {
    const double a = 5., alpha = .6, dt = 1e-3;
    GroundMotion motion;
    motion.dt = dt;
    motion.acceleration.assign(4001, {{3., 0., 4.}});
    const double exact = a * dt * (1. - std::exp(-.5 * alpha * 4.)) / (1. - std::exp(-.5 * alpha * dt));
    below("decaying sum of |a| dt of a constant / exact - 1",
          bounds_of(motion, alpha).oscillator / exact - 1., 1e-12);
  }

  /** Undamped and damped oscillators of all frequencies stay within the bound; one comes near. */
  void oscillators()
  {
    std::mt19937 engine(3);
    GroundMotion motion;
    motion.dt = 5e-3;
    for (unsigned int k = 0; k <= 2000; ++k)
      motion.acceleration.push_back({{engine() / 2147483647.5 - 1. + std::sin(6. * k * motion.dt), 0., 0.}});
    for (const double alpha : {0., .6})
    {
      const MotionBounds bounds = bounds_of(motion, alpha);
      double             worst = 0.;
      for (double w = .5; w < 300.; w *= 1.05)
      {
        double       u = 0., v = 0.; // Newmark's trapezoidal rule
        double       a = -motion.acceleration[0][0];
        const double dt = motion.dt, m = 1. + .5 * dt * alpha + .25 * dt * dt * w * w;
        for (std::size_t k = 1; k < motion.acceleration.size(); ++k)
        {
          const double v_p = v + .5 * dt * a, u_p = u + dt * v + .25 * dt * dt * a;
          a = (-motion.acceleration[k][0] - alpha * v_p - w * w * u_p) / m;
          v = v_p + .5 * dt * a;
          u = u_p + .25 * dt * dt * a;
          worst = std::max(worst, std::abs(v) / bounds.oscillator);
        }
      }
      between("oscillators with damping " + text(alpha) + ": fastest / bound", worst, .2, 1.);
    }
  }

  void excess()
  {
    Unknowns x(1000, 1.);
    report("nothing in excess", find_excess(x, 1.), "1000", find_excess(x, 1.) == 1000);
    x[700] = -3.;
    x[800] = 2.;
    report("the largest in excess", find_excess(x, 1.), "700", find_excess(x, 1.) == 700);
    x[900] = std::nan("");
    report("not a number before all", find_excess(x, 1.), "900", find_excess(x, 1.) == 900);
    report("not a number, none else", find_excess(x, 5.), "900", find_excess(x, 5.) == 900);
    x[900] = -HUGE_VAL;
    report("infinite", find_excess(x, 5.), "900", find_excess(x, 5.) == 900);
    report("no bound on no motion", find_excess(Unknowns(3, 0.), 0.), "3",
           find_excess(Unknowns(3, 0.), 0.) == 3);
  }
  void balances()
  {
    const Scene scene;
    const auto  message = [&](const double dam, const double rock) -> std::string
    {
      try
      {
        check_energies(scene, dam, rock, "output/this");
      }
      catch (const ComputationError &error)
      {
        return error.what();
      }
      return "";
    };
    report("a balance of 9e-5 is accepted", 9e-5, "", message(9e-5, 9e-5).empty());
    for (const double bad : {1.1e-4, std::nan(""), HUGE_VAL})
    {
      report("of the dam, refused", bad, "",
             message(bad, 0.).find("energies of the dam") != std::string::npos);
      report("of the rock, refused", bad, "", message(0., bad).find("rock_balance") != std::string::npos);
    }
    report("says where to look", 0., "", message(1., 0.).find("output/this") != std::string::npos);
  }

  /** A small tied dam on rock, and what is seen of it in half a second. @p gauss: Gauss points at the
   * boundary, which Foundation::check() refuses and which explode. */
  std::string watched(const bool gauss, unsigned int &step)
  {
    Scene scene;
    scene.mesh.source = "arch210";
    scene.mesh.arch210.n_joints = 2;
    scene.mesh.arch210.elements_along = 6;
    scene.mesh.arch210.elements_up = 3;
    scene.mesh.arch210.elements_through = 1;
    scene.mesh.arch210_rock.enabled = true;
    scene.mesh.arch210_rock.element_size = 60;
    scene.joints.model = "tied";
    scene.foundation.model = "rock";
    scene.foundation.stiffness_damping = 0.;
    scene.foundation.nodal_everywhere = !gauss;
    scene.foundation.nodal_layers = 0;
    const Dam dam(scene);

    GroundMotion motion;
    motion.dt = .9 * dynamic_cast<const ExplicitRock &>(*dam.foundation).critical_time_step();
    const unsigned int n = 3000;
    for (unsigned int k = 0; k <= n; ++k)
    {
      const double t = k * motion.dt, part = std::min(1., t) * std::exp(-t);
      motion.acceleration.push_back({{part * std::sin(12. * t), part * std::cos(17. * t), 0.}});
    }
    const Unknowns zero(3 * dam.structure.n_nodes(), 0.);
    dam.foundation->start(motion, {motion.dt, 1, n}, zero);
    Newmark newmark(dam.structure, dam.layout.laws, scene.contact, motion.dt, ImpactRule::mean_force);
    newmark.start(zero, zero, {}, zero, {});
    const StabilityMonitor watch(dam, motion, newmark);
    for (step = 1; step <= n; ++step)
    {
      Unknowns load = zero;
      dam.foundation->advance(load);
      newmark.advance(load, dam.foundation->base_velocity());
      dam.foundation->update_from_dam(newmark.state());
      const std::string trouble = watch.instability(newmark, step, step == n);
      if (!trouble.empty())
        return trouble;
    }
    return "";
  }

  void rock()
  {
    unsigned int      step = 0;
    const std::string sound = watched(false, step), exploding = watched(true, step);
    report("rock with nodal quadrature: nothing to say", sound.size(), "0", sound.empty());
    std::printf("%s\n", exploding.c_str());
    report("Gauss points at the boundary: seen in step", step, "< 2500", !exploding.empty() && step < 2500);
    for (const char *part : {"unstable", "mtf3", "step", "Foundation/Boundary", "Nodal quadrature"})
      report(std::string("  names ") + part, 0., "", exploding.find(part) != std::string::npos);
  }
} // namespace

int main()
{
  return run_all({sine, constant, oscillators, excess, balances, rock});
}
