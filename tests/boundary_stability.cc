// SPDX-License-Identifier: GPL-3.0-or-later
// Long runs of a quarter box of rock (12 x 12 x 12 cells, corner, edges, free surface) after a push on the
// ground: what is stable, and how the known mistakes fail. Without an argument 1e4 steps, or the number
// given.

#include "column.h"
#include "quarter_box.h"

#include "../benchmarks/boundary_canyon.h"

#include <voussoir/foundation/region_parameters.h>
#include <voussoir/rock/growth.h>
#include <voussoir/solid/critical_step.h>

namespace
{
  using namespace QuarterBoxes;
  using Columns::above;
  using Columns::below;

  unsigned int n_long = 10000;

  void stable()
  {
    for (const std::string name : {"mtf2", "mtf3", "viscous-spring"})
    {
      const auto   p = parameters(name);
      const Result r = run(p, quarter(p), n_long);
      below(name + ", nodal quadrature: max |u| after " + std::to_string(r.steps) + " steps / peak",
            r.end / r.peak, 1e-6);
      below("  energy balance / largest energy", r.energy_error, 1e-8);
    }
    auto p = parameters("mtf2");
    p.rock.nodal_everywhere = false;
    // Without damping rough waves stay in the core of Gauss points, whose frequencies the layers do not
    // carry.
    const Result early = run(p, quarter(p), n_long / 4), late = run(p, quarter(p), n_long);
    below("mtf2, 6 layers of nodal quadrature: max |u| / peak", late.end / late.peak, 1e-2);
    below("  late / early", late.end / early.end, 2.);
    p.damping.stiffness = .02 * p.dt;
    const Result damped = run(p, quarter(p), n_long);
    below("  with a stiffness damping of 0.02 dt: max |u| / peak", damped.end / damped.peak, 1e-6);
    Columns::report("  no warning", 0., "-", make_boundary(p)->warning(p).empty());
    // The default boundary with the little damping of a scene, 2e-5 s at steps of 2 ms.
    auto q = parameters(FoundationParameters().boundary);
    q.damping.stiffness = .01 * q.dt;
    const Result slightly = run(q, quarter(q), n_long);
    below(q.boundary + " (default), stiffness damping of 0.01 dt: max |u| / peak",
          slightly.end / slightly.peak, 1e-6);
    q.rock.nodal_everywhere = false;
    const Result layered = run(q, quarter(q), n_long);
    below("  with 6 layers of nodal quadrature only", layered.end / layered.peak, 1e-6);
  }

  /** The dam's elements in all of the box but what the boundary keeps. */
  void layers_at_dam()
  {
    for (const std::string name : {"mtf2", "mtf3", "mtf4", "viscous-spring"})
    {
      FoundationParameters scene;
      scene.boundary = name;
      scene.layers_at_dam = 1000;
      auto p = parameters(name);
      p.rock.layers_at_dam = scene.layers_at_dam;
      p.rock.nodal_layers = region_parameters(scene, p.rock.centre, p.dt).rock.nodal_layers;
      const RockModel model = quarter(p);
      const Result    early = run(p, model, n_long / 4), late = run(p, model, n_long);
      below(name + ", elements of the dam except in " + std::to_string(p.rock.nodal_layers) +
                " layers: max |u| / peak",
            late.end / late.peak, 1e-2);
      below("  late / early", late.end / early.end, 2.);
      p.damping.stiffness = .02 * p.dt;
      const Result damped = run(p, model, n_long);
      below("  with a stiffness damping of 0.02 dt: max |u| / peak", damped.end / damped.peak, 1e-6);
    }
    // In a large box they must end before the layers of the boundary begin, as Gauss points: see large().
    for (const unsigned int layers : {3, 1000})
    {
      auto p = parameters("mtf3");
      p.rock.layers_at_dam = layers;
      const RockModel   model = half_plane(p, 120, 120);
      const Result      r = run(p, model, 4000);
      const std::string what =
          "120 x 120 cells in plane strain, mtf3, " + std::to_string(layers) + " layers: end / peak";
      if (layers == 3)
        below(what, r.end / r.peak, 1e-2);
      else
        above(what, r.end / r.peak, 1.);
      Columns::report("  layers meet", 0., "-", (model.n_nodal_at_dam > 0) == (layers > 3));
    }
  }

  void gauss()
  {
    auto p = parameters("mtf2");
    p.rock.nodal_everywhere = false;
    p.rock.nodal_layers = 0;
    const Result r = run(p, quarter(p), 5000);
    above("Gauss points at the boundary: steps until it blows up", r.steps, 100.);
    below("  steps", r.steps, 1500.);
    Columns::report("  is warned of", 0., "-", !make_boundary(p)->warning(p).empty());
    above("  is seen in noise: growth of energy in 1000 steps", noise_growth(quarter(p), p, 1000), 10.);
    const auto q = parameters("mtf2");
    below("  growth with nodal quadrature", noise_growth(quarter(q), q, 1000), 1.);
  }

  void drift()
  {
    auto without = parameters("mtf2");
    without.boundary_maker = mtf2_without_gamma;
    const auto drifts = [](const RockRegionParameters &p)
    {
      const Result first = run(p, quarter(p), 4000), second = run(p, quarter(p), 8000);
      above("  max |u| after 4000 steps / peak of the first 1000", first.end / first.peak, 2.);
      Columns::between("  linearly: after 8000 / after 4000", second.end / first.end, 1.8, 2.3);
      Columns::report("  is warned of", 0., "-",
                      make_boundary(p)->warning(p).find("drift") != std::string::npos);
    };
    Columns::report("gamma = 0 drifts: speeds c_p and c_s", 0., "-", true);
    drifts(without);
    Columns::report("mtf2-plain", 0., "-", true);
    drifts(parameters("mtf2-plain"));
  }

  void diagonal()
  {
    for (const std::string name : {"mtf2", "mtf3"})
    {
      const auto   p = parameters(name);
      const Result box = run(p, with_diagonal_lines(quarter(p), {n, n, n}, false), 5000);
      const Result sheet = run(p, with_diagonal_lines(half_plane(p, 40, 20), {40, 1, 20}, true), 5000);
      if (name == "mtf3")
      {
        below("diagonal lines at edges, mtf3: steps until it blows up", box.steps, 4000.);
        below("  in plane strain", sheet.steps, 4000.);
      }
      else
      {
        Columns::note("diagonal lines at edges, mtf2: max |u| after 5000 steps / peak", box.end / box.peak);
        Columns::note("  in plane strain", sheet.end / sheet.peak);
      }
    }
    const auto   p = parameters("mtf3");
    const Result side = run(p, half_plane(p, 40, 20), n_long);
    below("mtf3 in plane strain, lines normal to the side: max |u| / peak", side.end / side.peak, 1e-6);
  }

  /** A time step of @p courant times the critical one, which a stiffness damping of @p share time steps
   * lowers. */
  void set_step(const RockModel &model, const double share, const double courant, RockRegionParameters &p)
  {
    const double w = largest_frequency(model.stiffness, model.mass);
    p.dt = 0.;
    for (unsigned int i = 0; i < 30; ++i)
    {
      p.damping.stiffness = share * p.dt;
      p.dt = courant * critical_time_step(w, p.damping);
    }
  }

  /** Returns the message of check_growth(), or an empty string. */
  std::string refusal(const RockRegionParameters &p, const RockModel &model)
  {
    const double w = largest_frequency(model.stiffness, model.mass);
    try
    {
      check_growth(p, critical_time_step(w, p.damping));
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }

  /** Rock of high Poisson's ratio grows near the critical step. Elements of the dam and free vertical faces
   * require more damping. All rows that grow in long runs are refused. The proposed damping is stable. */
  void poisson_near_critical()
  {
    struct Case
    {
      std::string  boundary;
      double       poisson, share, courant;
      unsigned int layers;   // at the dam
      std::string  proposal; // of the damping, in time steps; "-": accepted
    };
    for (const Case &c :
         std::vector<Case>{{"mtf3", .4, .005, .99, 3, "(0.02 "},
                           {"mtf3", .4, .005, .975, 3, "(0.0"},
                           {"mtf3", .4, .005, .9, 3, "-"},
                           {"mtf3", .4, .02, .99, 3, "-"},
                           {"mtf3", .45, .01, .99, 3, "(0.02 "},
                           {"mtf3", .38, .01, .9999, 0, "(0.02 "},
                           {"mtf2", .36, .005, .9999, 3, "(0.0"},
                           {"mtf2", .36, .02, .9999, 3, "-"},
                           {"mtf4", .45, .01, .99, 3, "Set \"Foundation/Boundary\" to viscous"},
                           {"mtf3", .329, 0., .99, 3, "(0.0"},
                           {"mtf3", .32, 0., .99, 3, "(0.0"},
                           {"mtf3", .29, 0., .99, 0, "-"}})
    {
      auto p = parameters(c.boundary);
      p.rock.materials[rock] = unit_rock(c.poisson);
      p.rock.layers_at_dam = c.layers;
      const RockModel model = quarter(p);
      set_step(model, c.share, c.courant, p);
      const std::string message = refusal(p, model);
      const bool        is_refused = !message.empty();
      Columns::report(c.boundary + ", Poisson's ratio " + Columns::text(c.poisson) + ", damping " +
                          Columns::text(c.share) + " dt, " + Columns::text(c.courant) +
                          " of the critical step, " + std::to_string(c.layers) +
                          " layers at the dam: refused",
                      is_refused, message.substr(0, 300), is_refused == (c.proposal != "-"));
      if (is_refused && c.proposal != "-")
        Columns::report("  proposal " + c.proposal, 0., "", message.find(c.proposal) != std::string::npos);
    }
  }

  /** Rock with Poisson's ratio 0.25 and less does not grow, so check_growth() does not measure it. */
  void not_measured()
  {
    for (const auto &[name, poisson] : std::vector<std::pair<std::string, double>>{
             {"mtf2", .25}, {"mtf3", .1}, {"mtf3", .25}, {"mtf4", .25}})
    {
      auto p = parameters(name);
      p.rock.materials[rock] = unit_rock(poisson);
      p.rock.layers_at_dam = 3;
      const RockModel model = quarter(p);
      set_step(model, 0., .999, p);
      for (const bool is_symmetric : {true, false})
        below(name + ", Poisson's ratio " + Columns::text(poisson) + ", no damping, " +
                  (is_symmetric ? "symmetric" : "free faces") + ": factor per step",
              std::exp(growth_per_step(p, p.dt / .999, is_symmetric)), 1. + largest_growth);
    }
  }

  /** Order 4 needs a layer of equal elements more than its lines have where the elements behind them are
   * bent. */
  void layers_of_order_4()
  {
    constexpr double h = .1;
    for (const unsigned int layers : {8, 9})
    {
      auto p = parameters("mtf4");
      p.rock.centre = {{0., 0., 0.}};
      const HexMesh   mesh = Benchmarks::CanyonMesh(h, 1.6 + layers * h, true).mesh;
      const RockModel model = make_rock_model(mesh, p.rock, tie_layer(mesh, 1));
      set_step(model, 0., .9, p);
      const double      growth = noise_growth(model, p, 8000);
      const std::string what =
          "mtf4 at a canyon, " + std::to_string(layers) + " equal layers: growth of noise";
      if (layers == make_boundary(p)->n_layers())
        below(what, growth, 1e-2);
      else
        above(what, growth, 1e2);
    }
    for (const std::string name : {"mtf1", "mtf2", "mtf3"})
      Columns::report("layers that " + name + " needs", make_boundary(parameters(name))->n_layers(), "= 6",
                      make_boundary(parameters(name))->n_layers() == 6);
  }

  /** Rock of high Poisson's ratio near the critical step: without damping it grows. Foundation::check() asks
   * for a stiffness damping of 0.005 dt, above 0.4 for 0.01 dt. */
  void poisson()
  {
    for (const double nu : {.4, .45})
      for (const double share : {0., nu > .4 ? .01 : .005})
      {
        const std::string name = "mtf4"; // the first to grow
        auto              p = parameters(name);
        p.rock.materials[rock] = unit_rock(nu);
        const RockModel model = quarter(p);
        set_step(model, share, .99, p);
        const Result      r = run(p, model, 6000);
        const std::string what = name + ", Poisson's ratio " + Columns::text(nu) +
                                 ", 0.99 of the critical step, damping " + Columns::text(share) +
                                 " dt: end / peak";
        if (share == 0.)
          above(what, r.end / r.peak, 1e3);
        else
          below(what, r.end / r.peak, 1e-2);
      }
  }

  /** A vertical force that stays, on the ground of a half-space: what the boundaries that hold static loads
   * leave of the settlement 3/(8 pi G r) (Boussinesq 1885, Poisson's ratio 1/4), r a third to two thirds of
   * the box. Their factors of spreading and springs were chosen for this. */
  void settlement()
  {
    for (const std::string name : {"mtf2", "mtf3", "viscous-spring"})
    {
      constexpr unsigned int size = 24, n_steps = 800;
      auto                   p = parameters(name);
      p.rock.centre = {{0., 0., double(size)}};
      const RockModel model =
          make_rock_model(box({size, size, size}, {"x+", "y+", "z-"},
                              [](const double i, const double j, const double k) -> Vector3 {
                                return {{i, j, k}};
                              }),
                          p.rock);
      const auto region = make_region(model, p);
      region->fix(symmetry(model));
      const unsigned int source = size * (size + 1) * (size + 1);
      region->force.assign(3 * model.points.size(), 0.);
      double least = 10., most = 0.;
      for (unsigned int i = 0; i < n_steps; ++i)
      {
        region->force[3 * source + 2] = -.25 * std::min(1., region->time() / 20.);
        region->advance();
      }
      for (const unsigned int r : {8, 12, 16})
      {
        const double ratio = -region->displacement()[3 * (source + r) + 2] * 8. * pi * r / 3.;
        least = std::min(least, ratio);
        most = std::max(most, ratio);
      }
      const bool is_transmitting = name != "viscous-spring";
      above("settlement / Boussinesq's, " + name + ", least", least, is_transmitting ? .95 : 1.);
      below("  most", most, is_transmitting ? 1.05 : 1.15);
    }
  }

  /** The gamma of a box falls with its number of cells: in a large one it does not hold mtf3 where the Gauss
   * points in the middle meet the layers. */
  void large()
  {
    for (const bool nodal : {false, true})
      for (const std::string name : {"mtf2", "mtf3"})
      {
        auto p = parameters(name);
        p.rock.nodal_everywhere = nodal;
        const Result      r = run(p, half_plane(p, 120, 120), 4000);
        const std::string what = "120 x 120 cells in plane strain, " + name +
                                 (nodal ? ", nodal quadrature" : ", 6 nodal layers") + ": end / peak";
        if (name == "mtf3" && !nodal)
          above(what, r.end / r.peak, 1.);
        else
          below(what, r.end / r.peak, 1e-2);
      }
  }
} // namespace

int main(const int argc, char **argv)
{
  if (argc > 1)
    n_long = std::stoi(argv[1]);
  return Columns::run_all({layers_at_dam, gauss, settlement, poisson, poisson_near_critical, not_measured,
                           layers_of_order_4, drift, diagonal, large, stable});
}
