// SPDX-License-Identifier: GPL-3.0-or-later
// Rock with a quality factor: its modulus, harmonic waves in layered ground, level ground, energy, stability.

#include "box.h"
#include "column.h"

#include <voussoir/base/error.h>
#include <voussoir/foundation/foundation_check.h>
#include <voussoir/rock/rock_region.h>

namespace
{
  using namespace Boxes;
  using Columns::below;

  Vector3 unit_cells(const double i, const double j, const double k)
  {
    return {{i, j, k}};
  }

  const std::vector<std::string> open_box = {"x-", "x+", "y-", "y+", "z-"};

  /** A quality factor in a band around the frequencies of the tests, with waves of speed 1. */
  RockDamping with_quality(const double quality)
  {
    RockDamping damping;
    damping.quality = quality;
    damping.lowest = .0125 / std::sqrt(20.);
    damping.highest = .0125 * std::sqrt(20.);
    return damping;
  }

  /** The modulus has the quality factor in the band, and the given wave velocity in its middle. */
  void modulus()
  {
    double of_quality = 0., of_velocity = 0.;
    for (const double quality : {10., 20., 50., 200., 1000.})
    {
      RockDamping damping;
      damping.quality = quality;
      const Relaxation   law = relaxation_of(damping);
      constexpr unsigned n = 400;
      for (unsigned int k = 0; k <= n; ++k)
      {
        const double w = 2. * pi * damping.lowest * std::pow(damping.highest / damping.lowest, double(k) / n);
        const std::complex<double> m = law.modulus(w);
        of_quality = std::max(of_quality, std::abs(quality * m.imag() / m.real() - 1.));
        if (2 * k == n)
          of_velocity = std::max(of_velocity, std::abs((1. / std::sqrt(m)).real() - 1.));
      }
    }
    below("quality factor 10 to 1000, 0.5 to 10 Hz: relative error", of_quality,
          RockDamping::error_of_quality);
    below("  velocity in the middle of the band: relative error", of_velocity, 1e-12);
    Columns::between("  modulus without a quality factor", relaxation_of(RockDamping()).modulus(3.).real(),
                     1., 1.);
  }

  /** The values that doc/rock.md states: s, wave velocities at the ends of the band, Q outside of the band. */
  void dispersion()
  {
    for (const auto &[quality, s, slow, fast] :
         std::vector<std::array<double, 4>>{{{50., 1.04, .99, 1.01}}, {{10., 1.22, .95, 1.05}}})
    {
      RockDamping damping;
      damping.quality = quality;
      const Relaxation  law = relaxation_of(damping);
      const auto        at = [&](const double f) { return law.modulus(2. * pi * f); };
      const auto        velocity = [&](const double f) { return 1. / (1. / std::sqrt(at(f))).real(); };
      const std::string name = "Q " + Columns::text(quality) + ": ";
      Columns::between(name + "modulus at infinite frequency", law.unrelaxed, s - .005, s + .005);
      Columns::between(name + "velocity at 0.5 Hz", velocity(.5), slow - .005, slow + .005);
      Columns::between(name + "velocity at 10 Hz", velocity(10.), fast - .005, fast + .005);
      if (quality == 50.)
      {
        Columns::between(name + "Q at 0.1 Hz over Q", at(.1).real() / at(.1).imag() / quality, 2.1, 2.3);
        Columns::between(name + "Q at 30 Hz over Q", at(30.).real() / at(30.).imag() / quality, 1.4, 1.6);
      }
    }
  }

  constexpr int stiff = rock + 1; ///< the volume of a half-space below a layer

  /** Rock of unit speed on rock of speed 2 and density 1.1 below z = @p below. */
  HexMesh layered(HexMesh mesh, RockRegionParameters &p, const double below)
  {
    for (auto &cell : mesh.cells)
      if (centre(mesh, cell.nodes)[2] < below)
        cell.volume = stiff;
    Material m = unit_rock();
    m.density = 1.1;
    m.young *= 1.1 * 4.;
    p.rock.materials = {{rock, unit_rock()}, {stiff, m}};
    p.dt = .12;
    return mesh;
  }

  /** Harmonic waves from below: a layer of thickness H on a half-space has the complex wave number k = w/c in
   * the layer. The amplitude is 2 |exp(-i k_2 d)| / |cos kH + i sin kH (rho c)_1 / (rho c)_2|, where the waves
   * enter at the distance d below the layer. */
  void layer_on_half_space()
  {
    RockRegionParameters p;
    constexpr double     H = 20., period = 4. * H, n_below = 70.;
    const HexMesh        mesh = layered(box({2, 2, unsigned(H + n_below)}, open_box, unit_cells), p, n_below);
    const RockModel      model = make_rock_model(mesh, p.rock);
    p.damping = with_quality(20.);
    const std::array<double, 3> factor = {{1., .25, 3.}}; // of the frequency, per component
    const double                w0 = 2. * pi / period;
    const unsigned int          n = std::lround(24. * period / p.dt);
    FreeField                   field(model, p.damping, p.dt, n,
                                      [&](const double t) -> Vector3
                                      {
                      const double rise = t < 8. * period ? .5 - .5 * std::cos(pi * t / 8. / period) : 1.;
                      Vector3      value;
                      for (unsigned int c = 0; c < 3; ++c)
                        value[c] = rise * std::sin(factor[c] * w0 * t);
                      return value;
                    });
    field.add_nodes(model, {static_cast<unsigned int>(model.points.size()) - 1});
    Unknowns u;
    Vector3  largest{};
    for (unsigned int i = 1; i <= n; ++i)
    {
      field.advance();
      field.evaluate(u);
      for (unsigned int c = 0; c < 3 && i * p.dt > 19. * period; ++c)
        largest[c] = std::max(largest[c], std::abs(u[c]));
    }
    const Relaxation           law = relaxation_of(p.damping);
    const std::complex<double> i(0., 1.);
    for (unsigned int c = 0; c < 3; ++c)
    {
      const double               w = factor[c] * w0, speed = c == 2 ? std::sqrt(3.) : 1.;
      const std::complex<double> k = w / (speed * std::sqrt(law.modulus(w))), k_below = .5 * k;
      const double               expected = 2. * std::abs(std::exp(-i * k_below * (n_below + 1.)) /
                                                          (std::cos(k * H) + i * std::sin(k * H) / 2.2));
      below("layer on half-space, Q 20, " + std::string(c == 2 ? "P" : "S") + " at " +
                std::to_string(factor[c]) + " c/4H: amplitude " + std::to_string(expected) + ", error",
            std::abs(largest[c] / expected - 1.), .004);
    }
  }

  Vector3 pulse(const double t)
  {
    return {{ricker(t, .05, 30.), .7 * ricker(t, .04, 35.), .5 * ricker(t, .06, 28.)}};
  }

  void level_ground_by(const std::string &free_field, const double stiffness)
  {
    RockRegionParameters p;
    p.rock.nodal_everywhere = true;
    HexMesh mesh = layered(box({14, 13, 12}, open_box, unit_cells), p, 8.);
    p.rock.centre = {{7., 6.5, 12.}};
    p.free_field = free_field;
    p.damping = with_quality(15.);
    p.damping.stiffness = stiffness * p.dt;
    const Difference r = difference(make_rock_model(mesh, p.rock), p, pulse, "columns", 400);
    below("level ground, Q 15, by " + free_field + ", stiffness damping " + std::to_string(stiffness) +
              " dt: total - free field / peak",
          r.error / r.peak, 1e-10);
    below("  energy balance / largest energy", r.energy_error, 1e-10);
  }

  /** Level ground has the motion of its columns, and the energy balance closes. */
  void level_ground()
  {
    for (const double stiffness : {0., .02})
      for (const char *free_field : {"columns", "sections"})
        level_ground_by(free_field, stiffness);
  }

  /** Rock in which a shear beam moves in x, between z = 0, which is fixed, and a free end. */
  struct Beam
  {
    explicit Beam(const RockDamping &damping, const double dt, const unsigned int n) : n(n)
    {
      RockRegionParameters p;
      p.rock.materials = {{rock, unit_rock()}};
      p.rock.nodal_everywhere = true;
      p.boundary = "fixed";
      p.dt = dt;
      p.damping = damping;
      model = make_rock_model(box({2, 2, n}, {"z-"}, unit_cells), p.rock);
      region = make_region(model, p);
      std::vector<unsigned int> fixed;
      for (unsigned int i = 0; i < model.points.size(); ++i)
        fixed.insert(fixed.end(), {3 * i + 1, 3 * i + 2});
      region->fix(fixed);
      region->keep_energy();
    }

    /** Starts with the velocity 1 of the end in the given mode: 1, 3, 5, ... quarter waves. */
    void start(const unsigned int quarters)
    {
      Unknowns u(3 * model.points.size(), 0.), v = u;
      for (unsigned int i = 0; i < model.points.size(); ++i)
        v[3 * i] = std::sin(.5 * quarters * pi * model.points[i][2] / n);
      region->start(u, v);
    }

    unsigned int                    n;
    RockModel                       model;
    std::unique_ptr<ExplicitRegion> region;
  };

  /** The energy of free vibrations decays by exp(-w t/Q), and only dissipation takes it. */
  void decay(const double quality, const unsigned int n, const unsigned int quarters, const double dt)
  {
    const double w = 2. * std::sin(.25 * quarters * pi / n); // of the discrete beam
    RockDamping  damping = with_quality(quality);
    damping.lowest = w / (2. * pi * std::sqrt(20.));
    damping.highest = 20. * damping.lowest;
    Beam beam(damping, dt, n);
    beam.start(quarters);
    const unsigned int period = std::max(1L, std::lround(2. * pi / w / dt));
    double             at_begin = 0., least = 0., before = 0., largest = 0., balance = 0.;
    for (unsigned int i = 1; i <= 6 * period; ++i)
    {
      beam.region->advance();
      const RegionEnergy e = beam.region->energy();
      largest = std::max(largest, e.kinetic + e.strain);
      least = std::min(least, e.damping - before);
      before = e.damping;
      balance = std::max(balance, std::abs(e.balance()));
      if (i == period)
        at_begin = e.kinetic + e.strain;
    }
    const RegionEnergy e = beam.region->energy();
    const double       found = 5. * period * dt * w / std::log(at_begin / (e.kinetic + e.strain));
    const std::string  name =
        "free vibration, Q " + Columns::text(quality) + ", w dt " + Columns::text(w * dt);
    if (w * dt < .01) // else the error of the scheme in w is not small
      below(name + ": error of the quality factor by the decay of energy", std::abs(found / quality - 1.),
            .03);
    else
      Columns::note(name + ": quality factor by the decay of energy", found);
    below("  energy balance / largest energy", balance / largest, 1e-10);
    below("  energy that the damping returns / largest energy", std::max(0., -least) / largest, 1e-12);
  }

  void decay()
  {
    decay(20., 40, 1, .1);
    for (const double quality : {10., 20., 50.})
      for (const unsigned int quarters : {1, 7, 15})
        decay(quality, 8, quarters, .38); // 8 steps per period in the highest mode
  }

  /** An oscillator is stable below critical_time_step(), and unstable above. */
  void critical_step()
  {
    for (const double stiffness : {0., .2})
      for (const double share : {.999, 1.001})
      {
        RockDamping damping = with_quality(10.);
        damping.stiffness = stiffness;
        constexpr double w0 = 2.;
        const double     dt = share * critical_time_step(w0, damping);
        DampedMotion     damped(damping, dt, 1);
        double           u = 0., w = 1., x = 0., peak = 0.;
        for (unsigned int i = 0; i < 20000 && peak < 1e6; ++i)
        {
          u += dt * w;
          damped.advance(&u, &w, &x, 0, 1);
          w -= dt * w0 * w0 * x;
          peak = std::max(peak, std::abs(u));
        }
        Columns::report("oscillator, " + Columns::text(share) + " of the critical step, stiffness damping " +
                            Columns::text(stiffness) + ": peak",
                        peak, share < 1. ? "stable" : "unstable", (peak < 10.) == (share < 1.));
      }
  }

  /** A bottom at different heights is refused. */
  void stepped_bottom()
  {
    RockRegionParameters p;
    p.rock.materials = {{rock, unit_rock()}};
    p.damping = with_quality(20.);
    const auto step = [](const double i, const double j, const double k) -> Vector3 {
      return {{i, j, i < 7. ? k : 3. + .75 * k}};
    };
    std::string message;
    try
    {
      check_waves(make_rock_model(box({14, 13, 12}, open_box, step), p.rock), p);
    }
    catch (const InputError &error)
    {
      message = error.what();
    }
    Columns::report("a stepped bottom is refused", 0., "level bottom",
                    message.find("level bottom") != std::string::npos);
    p.damping.quality = 0.;
    check_waves(make_rock_model(box({14, 13, 12}, open_box, step), p.rock), p);
  }

  /** Rock with a quality factor is stable at the boundary, also near the critical time step. */
  void stability()
  {
    for (const double nu : {.2, .25})
      for (const double quality : {10., 50.})
        for (const double courant : {.6, .95})
        {
          RockRegionParameters p;
          p.rock.materials = {{rock, unit_rock(nu)}};
          p.rock.nodal_everywhere = true;
          p.rock.layers_at_dam = 3;
          p.damping = with_quality(quality);
          p.dt = .2;
          const double growth =
              std::max(growth_per_step(p, p.dt / courant, true), growth_per_step(p, p.dt / courant, false));
          below("nu " + std::to_string(nu) + ", Q " + std::to_string(quality) + ", " +
                    std::to_string(courant) + " of the critical time step: growth per step",
                std::max(0., growth), largest_growth);
        }
  }
} // namespace

int main()
{
  return Columns::run_all({modulus, dispersion, layer_on_half_space, [] { decay(); }, critical_step,
                           stepped_bottom, level_ground, stability});
}
