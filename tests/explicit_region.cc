// SPDX-License-Identifier: GPL-3.0-or-later
// The explicit region itself: nodes whose motion is handed in, the energy account, restart, stability limit.

#include "box.h"
#include "column.h"

#include <voussoir/motion/motion.h>
#include <voussoir/solid/critical_step.h>

namespace
{
  using namespace Boxes;
  using Columns::below;
  using Columns::report;

  constexpr unsigned int n = 14;

  HexMesh cube()
  {
    return box({n, n, n}, {"x-", "x+", "y-", "y+", "z-"},
               [](const double i, const double j, const double k) -> Vector3 {
                 return {{i, j, k}};
               });
  }

  RockRegionParameters parameters()
  {
    RockRegionParameters p;
    p.boundary = "mtf2"; // its lines leave room in a small cube
    p.rock.materials[rock] = unit_rock();
    p.rock.nodal_everywhere = true;
    p.rock.centre = {{.5 * n, .5 * n, double(n)}};
    p.dt = .25;
    p.damping = {.01, .03};
    p.free_field = "columns";
    return p;
  }

  Vector3 pulse(const double t)
  {
    return {{ricker(t, .1, 15.), .5 * ricker(t, .08, 16.), ricker(t, .07, 17.)}};
  }

  std::unique_ptr<ExplicitRegion> shaken(const RockModel &model, const RockRegionParameters &p)
  {
    auto region = make_region(model, p);
    shake(*region, model, p, pulse, 400);
    region->keep_energy();
    return region;
  }

  double largest_difference(const Unknowns &a, const Unknowns &b)
  {
    double d = 0.;
    for (std::size_t i = 0; i < a.size(); ++i)
      d = std::abs(a[i] - b[i]) <= d ? d : std::abs(a[i] - b[i]);
    return d;
  }

  /** A region some of whose nodes are led along its own motion moves as before, and the force on them is that
   * of equilibrium. */
  void prescribed()
  {
    const HexMesh             mesh = cube();
    const auto                p = parameters();
    const RockModel           model = make_rock_model(mesh, p.rock);
    auto                      leader = shaken(model, p), region = shaken(model, p);
    std::vector<unsigned int> nodes;
    for (unsigned int i = 0; i < model.points.size(); ++i)
    {
      const auto &x = model.points[i];
      if (x[2] == n && std::abs(x[0] - .5 * n) < 2. && std::abs(x[1] - .5 * n) < 2.)
        nodes.push_back(i);
    }
    region->set_prescribed(nodes);
    double   error = 0., force_error = 0., energy_error = 0., largest = 0., peak = 0.;
    Unknowns before = leader->displacement(), older = before;
    for (unsigned int step = 0; step < 300; ++step)
    {
      older = before;
      before = leader->displacement();
      leader->advance();
      const Unknowns &now = leader->displacement();
      Unknowns        u, v, inertia;
      for (const unsigned int node : nodes)
        for (unsigned int c = 0; c < 3; ++c)
        {
          u.push_back(now[3 * node + c]);
          v.push_back((now[3 * node + c] - before[3 * node + c]) / p.dt);
        }
      const Unknowns force = region->advance(u, v);
      error = std::max(error, largest_difference(now, region->displacement()));
      // Free nodes: the force of the elements is minus the mass times the acceleration, known a step later.
      Unknowns        balance;
      const Unknowns &w = leader->half_step_velocity();
      for (unsigned int i = 0; i < nodes.size(); ++i)
        for (unsigned int c = 0; c < 3; ++c)
        {
          const double a = (w[3 * nodes[i] + c] - v[3 * i + c]) / p.dt;
          balance.push_back(force[3 * i + c] + model.mass[nodes[i]] * a);
          peak = std::max(peak, std::abs(force[3 * i + c]));
        }
      force_error = std::max(force_error, largest_difference(balance, Unknowns(balance.size(), 0.)));
      const RegionEnergy &e = region->energy();
      largest = std::max(largest, e.kinetic + e.strain);
      energy_error = std::max(energy_error, std::abs(e.balance()));
    }
    below("nodes led along the region's own motion: error of u", error, 1e-12);
    below("  force + mass acceleration / largest force", force_error / peak, 1e-10);
    below("  energy account / largest energy", energy_error / largest, 1e-10);
  }

  /** Any motion of the nodes, unlike what their own dynamics would be. */
  void driven()
  {
    const HexMesh   mesh = cube();
    auto            p = parameters();
    const RockModel model = make_rock_model(mesh, p.rock);
    for (const std::string boundary : {"mtf2", "mtf3", "viscous", "viscous-spring", "fixed"})
    {
      p.boundary = boundary;
      auto               region = make_region(model, p);
      const unsigned int node = (n * (n + 1) + n / 2) * (n + 1) + n / 2;
      region->keep_energy();
      region->set_prescribed({node});
      double error = 0., largest = 0.;
      for (unsigned int step = 1; step <= 600; ++step)
      {
        const double t = step * p.dt, w = .5;
        const double u = std::sin(w * t) * std::min(1., t / 30.),
                     v = w * std::cos(w * t) * std::min(1., t / 30.);
        region->advance({0., .3 * u, u}, {0., .3 * v, v});
        largest = std::max(largest, region->energy().kinetic + region->energy().strain);
        error = std::abs(region->energy().balance()) <= error ? error : std::abs(region->energy().balance());
      }
      below(boundary + ", driven at a node: energy account / largest energy", error / largest, 1e-8);
      if (boundary != "fixed")
        Columns::above("  part of the work that left",
                       region->energy().transmitted / region->energy().prescribed, .2);
    }
  }

  /** Nodes that are led must not lie on the lines of the boundary, which may then be unstable. */
  void refuses()
  {
    const RockModel model = make_rock_model(cube(), parameters().rock);
    auto            region = make_region(model, parameters());
    std::string     message;
    try
    {
      region->set_prescribed({model.lines[0].nodes[3]});
    }
    catch (const std::exception &error)
    {
      message = error.what();
    }
    report("nodes led too near the boundary are refused", 0., "-",
           message.find("too near") != std::string::npos);
  }

  void restart()
  {
    const HexMesh   mesh = cube();
    auto            p = parameters();
    const RockModel model = make_rock_model(mesh, p.rock);
    for (const std::string boundary : {"mtf2", "viscous-spring"})
      for (const std::string field : {"columns", "sections"})
      {
        p.boundary = boundary;
        p.free_field = field;
        auto first = shaken(model, p), second = shaken(model, p);
        second->advance(); // it is to forget this
        for (unsigned int step = 0; step < 150; ++step)
          first->advance();
        const auto from = first->state(), to = second->state();
        for (std::size_t i = 0; i < from.size(); ++i)
          *to[i] = *from[i];
        double difference = 0., peak = 0.;
        for (unsigned int step = 0; step < 100; ++step)
        {
          first->advance();
          second->advance();
          difference =
              std::max(difference, largest_difference(first->displacement(), second->displacement()));
          for (const double u : first->displacement())
            peak = std::max(peak, std::abs(u));
        }
        report("restart, " + boundary + ", " + field + ": difference", difference, "= 0",
               difference == 0. && peak > .1);
        below("  energy account, difference", first->energy().balance() - second->energy().balance(), 1e-10);
      }
  }

  /** A region at the stability limit, damping included. */
  void limit()
  {
    auto p = parameters();
    p.damping = {0., .2};
    p.boundary = "fixed";
    const RockModel model = make_rock_model(cube(), p.rock);
    const double    w = largest_frequency(model.stiffness, model.mass), xi = .5 * w * p.damping.stiffness;
    const double    critical = critical_time_step(w, p.damping);
    below("critical time step with damping - formula", critical * w - 2. * (std::sqrt(1. + xi * xi) - xi),
          1e-12);
    p.dt = .99 * critical;
    below("dt = 0.99 critical: growth of noise in 2000 steps", noise_growth(model, p), 1.);
  }

  /** Cells that grow: many frequencies near the largest, which power iteration takes thousands of products to
   * tell from each other. */
  void largest()
  {
    const auto      p = parameters();
    const HexMesh   mesh = box({n, n, n}, {"x-", "x+", "y-", "y+", "z-"},
                               [](const double i, const double j, const double k) -> Vector3 {
                               return {{i + .02 * i * i, j + .01 * j * j, k + .015 * k * k}};
                             });
    const RockModel model = make_rock_model(mesh, p.rock);
    Unknowns        x(3 * model.points.size()), y(x.size());
    for (std::size_t k = 0; k < x.size(); ++k)
      x[k] = std::sin(12.9898 * double(k));
    double w2 = 0.;
    for (unsigned int iteration = 0; iteration < 5000; ++iteration)
    {
      model.stiffness.multiply(x.data(), y.data());
      double size = 0., product = 0.;
      for (std::size_t k = 0; k < x.size(); ++k)
      {
        product += x[k] * y[k];
        size += x[k] * model.mass[k / 3] * x[k];
        x[k] = y[k] / model.mass[k / 3];
      }
      w2 = product / size;
      double most = 0.;
      for (const double value : x)
        most = std::max(most, std::abs(value));
      for (double &value : x)
        value /= most;
    }
    const double ratio = largest_frequency(model.stiffness, model.mass) / std::sqrt(w2);
    Columns::between("largest frequency / that of 5000 power iterations, a lower bound", ratio, 1.,
                     1. + 1e-5);
  }

  /** Chain of masses whose ends are held, w = 2 sin(pi n / (2 (n + 1))): its many frequencies near the
   * largest keep Lanczos' estimate below. */
  void largest_of_chain()
  {
    for (const unsigned int size : {100, 400, 6400})
    {
      BlockSparseMatrix K;
      K.start.assign(1, 0);
      for (unsigned int i = 0; i < size; ++i)
      {
        for (int j = int(i) - 1; j <= int(i) + 1; ++j)
          if (j >= 0 && j < int(size))
          {
            const double k = j == int(i) ? 2. : -1.;
            K.column.push_back(j);
            K.value.push_back({{k, 0., 0., 0., k, 0., 0., 0., k}});
          }
        K.start.push_back(K.column.size());
      }
      const double exact = 2. * std::sin(.5 * pi * size / (size + 1.));
      Columns::between("largest frequency of a chain of " + std::to_string(size) + " / exact",
                       largest_frequency(K, std::vector<double>(size, 1.)) / exact, 1. - 1e-14, 1. + 1e-4);
    }
  }

  /** The record's exact double integral. */
  void wave()
  {
    GroundMotion motion;
    motion.dt = .01;
    const double w = 7.;
    for (unsigned int i = 0; i <= 500; ++i)
      motion.acceleration.push_back({{0., 6. * i * motion.dt, -2. * w * w * std::sin(w * i * motion.dt)}});
    const IncidentWave u = incident_wave(motion);
    below("incident wave of a = 6 t: u - t^3/2", u(3.123)[1] - .5 * std::pow(3.123, 3), 1e-11);
    below("  of a = -2 w^2 sin w t: u - (sin w t - w t)", u(3.123)[2] - (std::sin(w * 3.123) - w * 3.123),
          1e-2);
  }
} // namespace

int main()
{
  return Columns::run_all({prescribed, driven, refuses, restart, limit, largest, largest_of_chain, wave});
}
