// The bounds that a run is watched with: against closed forms, and against oscillators on random ground.

#include "column.h"

#include <voussoir/motion.h>
#include <voussoir/stability_watch.h>

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
} // namespace

int main()
{
  return run_all({sine, oscillators, excess});
}
